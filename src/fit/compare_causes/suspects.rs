//! What may have happened between two sets of fits, and which parameters that moves.

use crate::fit::compare::Pair;
use crate::fit::parameter::Identified;
use std::collections::BTreeSet;

/// A parameter as it changed.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Row {
    pub(super) name: String,
    pub(super) site: String,
    unit: String,
    kind: String,
    /// Relative change and its standard error.
    pub(super) change: [f64; 2],
    /// Whether it was there on both sides: a factor cannot make something of nothing.
    scales: bool,
}

/// Something that may have happened between the two sets.
#[derive(Debug, Clone, PartialEq)]
pub struct Suspect {
    /// Its name in the library (`ident effects NAME`); none: no known cause moves this parameter alone.
    pub cause: Option<&'static str>,
    /// Where; empty for the whole.
    pub site: String,
    /// What it means here.
    pub says: String,
    /// Rows that it moves, with the power of its factor.
    pub(super) moves: Vec<(usize, f64)>,
}

/// Units with the powers of force and of the displacement that was measured.
const UNITS: &[(&str, f64, f64)] = &[
    ("N·m/rad", 1.0, -1.0),
    ("N/m", 1.0, -1.0),
    ("N·m", 1.0, 0.0),
    ("N", 1.0, 0.0),
    ("rad", 0.0, 1.0),
    ("m", 0.0, 1.0),
    ("J", 1.0, 1.0),
    ("N·m·s/rad", 1.0, -1.0),
];
/// Kinds of fit whose force and displacement pass one pair of instruments.
const STATIC: &[&str] = &["ident-fit/1", "ident-cubes/1"];
/// Parameters of friction, which warm gears and oil lower alike (Bittencourt and Gunnarsson 2012).
const FRICTION: &[&str] = &["damping", "friction", "slip_load", "viscous"];

pub(super) fn row(pair: &Pair) -> Option<Row> {
    let [before, after] = &pair.sides;
    let [change, error] = pair.change?;
    let size = |p: &Identified| p.value.map(f64::abs);
    let scales = size(before).is_some() && size(after).is_some();
    let sizes: Vec<f64> = [size(before), size(after)].into_iter().flatten().collect();
    let mean = sizes.iter().sum::<f64>() / sizes.len() as f64;
    (mean > 0.0 && error.is_finite()).then(|| Row {
        name: before.name.clone(),
        site: before.site.clone(),
        unit: before.unit.clone(),
        kind: pair.kind.clone(),
        change: [change / mean, error / mean],
        scales,
    })
}

fn powers(row: &Row) -> (f64, f64) {
    let found = UNITS.iter().find(|unit| unit.0 == row.unit);
    found.map_or((0.0, 0.0), |unit| (unit.1, unit.2))
}

/// Whatever could have happened: instruments of each kind, warmth, and every parameter by itself.
pub(super) fn suspects(rows: &[Row]) -> Vec<Suspect> {
    let mut all = Vec::new();
    for kind in STATIC {
        let of = |power: fn(&Row) -> f64| -> Vec<(usize, f64)> {
            let own = |row: &Row| row.kind == *kind && row.scales && power(row) != 0.0;
            let own = rows.iter().enumerate().filter(|(_, row)| own(row));
            own.map(|(i, row)| (i, power(row))).collect()
        };
        let instruments = [
            (
                "force_gain",
                "the force was read, or its lever taken, too large or too small on one side",
                of(|r| powers(r).0),
            ),
            (
                "sensor_gain",
                "the displacement was read, or the sensor's lever taken, too large or too small on one side",
                of(|r| powers(r).1),
            ),
        ];
        for (cause, says, moves) in instruments {
            all.push(Suspect {
                cause: Some(cause),
                site: String::new(),
                says: says.into(),
                moves,
            });
        }
    }
    let friction = |row: &Row| row.scales && FRICTION.contains(&row.name.as_str());
    let moves = rows.iter().enumerate().filter(|(_, row)| friction(row));
    all.push(Suspect {
        cause: Some("temperature"),
        site: String::new(),
        says: "friction and damping of all joints alike: warmer or colder gears, other grease"
            .into(),
        moves: moves.map(|(i, _)| (i, 1.0)).collect(),
    });
    all.retain(|suspect| suspect.moves.len() > 1);
    let own: BTreeSet<(&str, &str)> = rows
        .iter()
        .map(|row| (&row.site[..], &row.name[..]))
        .collect();
    all.extend(own.into_iter().map(|(site, name)| alone(rows, site, name)));
    all
}

pub(super) fn is_wide(suspect: &Suspect) -> bool {
    suspect.site.is_empty()
}

/// One parameter by itself, in all fits that know it.
fn alone(rows: &[Row], site: &str, name: &str) -> Suspect {
    let tilt = site.ends_with("-tilt");
    let (cause, says) = match name {
        "stiffness" if tilt => (Some("tilt_stiffness"), "the bearing alone"),
        "stiffness" => (
            Some("drive_stiffness"),
            "the drive alone: its gear, its coupling, its bolts",
        ),
        "gap" | "contact_load" | "centre" | "edge" => (
            Some("backlash"),
            "a gap alone: wear, or a preload that was lost",
        ),
        "width" | "slip_load" | "spread" | "tilt" => {
            (Some("hysteresis"), "the friction of this joint alone")
        }
        "friction" => (Some("coulomb_friction"), "the friction of this joint alone"),
        "damping" => (Some("joint_damping"), "the damping of this joint alone"),
        _ => (None, "no cause of the library moves this alone"),
    };
    let own = rows
        .iter()
        .enumerate()
        .filter(|(_, row)| row.site == site && row.name == name);
    Suspect {
        cause,
        site: site.into(),
        says: format!("{name} of {site}: {says}"),
        moves: own.map(|(i, _)| (i, 1.0)).collect(),
    }
}
