//! Units: the measured stiffness beside the nominal one.

use super::{Course, Rule};
use crate::experiments::load_cycle::straight_line;
use crate::fit::suitability::magnitude::{explanation, times};
use crate::fit::suitability::{Said, Weight};
use crate::measurement::load_cycle::{LEVER_REL_STD, LoadCycle, Port};
use crate::robot::load::load;

/// A stiffness far from the nominal one may be a unit or a lever, not the joint.
pub const RULE: Rule = Rule {
    name: "scale",
    remedy: "check the units at the ends of the column names, the levers (metres) and the nominal stiffness",
    look,
};

/// Spread of a nominal stiffness that nobody stated.
const SPREAD: f64 = 0.05;
/// A line and a joint's stiffness differ by this share for play and friction alone.
const SHAPE: f64 = 0.15;
/// Spreads beyond which the nominal value contradicts the measured one.
const SPREADS: f64 = 5.0;
/// No joint is off by this factor: a unit is.
const UNIT: f64 = 30.0;
/// Levers of robots and rigs, m.
const LEVERS: std::ops::RangeInclusive<f64> = 0.02..=4.0;

fn look(on: &Course) -> Said {
    let file = on.file;
    let mut found = levers(file);
    let line = straight_line(&file.load, &on.deflection);
    if !(line.is_finite() && line > 0.0 && on.relation.is_real()) {
        return found;
    }
    let Some(nominal) = file.facts.nominal_stiffness else {
        found.extend(beside_robot(file, line));
        return found;
    };
    let ratio = line / nominal;
    let lever = file.facts.lever_rel_std.unwrap_or(LEVER_REL_STD);
    let spread = file
        .facts
        .nominal_rel_std
        .unwrap_or(SPREAD)
        .hypot(lever * std::f64::consts::SQRT_2);
    if ratio.ln().abs() < SPREADS * spread + SHAPE {
        return found;
    }
    let what = format!(
        "the stiffness comes out {} the nominal one, beyond {SPREADS:.0} of its stated spreads{}",
        times(ratio),
        why(ratio)
    );
    let weight = match ratio.max(1.0 / ratio) > UNIT {
        true => Weight::Fatal,
        false => Weight::Odd,
    };
    found.push((weight, what));
    found
}

/// The same beside the robot that the file names, of which no spread is known: only what no joint is off by.
fn beside_robot(file: &LoadCycle, line: f64) -> Option<(Weight, String)> {
    file.facts.axis.filter(|_| file.port == Port::Rotational)?;
    let robot = load(file.facts.robot.as_ref()?, Some(&file.path)).ok()?;
    let site = file.site();
    let own = robot.robot.springs().find(|(name, _)| *name == site)?.1;
    let ratio = line / own.stiffness;
    let is_far = ratio.max(1.0 / ratio) > UNIT;
    is_far.then(|| {
        let [times, why] = [times(ratio), why(ratio)];
        let what = format!("the stiffness comes out {times} that of {site} of the robot{why}");
        (Weight::Fatal, what)
    })
}

/// A unit or a lever that would make such a ratio, as the end of a clause.
fn why(ratio: f64) -> String {
    explanation(ratio).map_or(String::new(), |why| format!("; {why}"))
}

/// Levers that no rig has.
fn levers(file: &LoadCycle) -> Said {
    let facts = &file.facts;
    let stated = [
        ("load_lever_m", facts.load_lever),
        ("sensor_lever_m", facts.sensor_lever),
        ("sensor2_lever_m", facts.sensor2_lever),
    ];
    let odd = stated
        .into_iter()
        .filter_map(|(key, lever)| Some((key, lever?)));
    odd.filter(|(_, lever)| !LEVERS.contains(lever))
        .map(|(key, lever)| {
            (
                Weight::Odd,
                format!("`{key}` is {lever} m, which is no lever of a robot"),
            )
        })
        .collect()
}
