//! Which known cause would explain what changed between two sets of fits.
//!
//! Every parameter gives a row: its relative change and the standard error of that. A cause moves some rows by
//! one amount: a soft drive its stiffness in every fit that knows it, a gain of a force sensor every parameter
//! by the power with which its unit holds a force. Sets of causes are weighed by what they leave and what they
//! cost (Chen and Chen, Extended Bayesian information criteria, Biometrika 2008: the more causes could have
//! been taken, the dearer each is). Sets that are weighed alike are told as not separable.

use super::compare::{Comparison, Pair};
use super::parameter::{Identified, Z95};
use std::collections::BTreeSet;

/// Sets within these odds of the best (1 to 20) are not separable from it: twice the logarithm.
const ALIKE: f64 = 5.99;
/// Most causes of whole campaigns in one set.
const WIDE: usize = 2;
/// Rows that every set leaves beyond this many standard errors, over all rows at 5 %, are told as left.
const LEVEL: f64 = 0.05;

/// A parameter as it changed.
#[derive(Debug, Clone, PartialEq)]
struct Row {
    name: String,
    site: String,
    unit: String,
    kind: String,
    /// Relative change and its standard error.
    change: [f64; 2],
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
    moves: Vec<(usize, f64)>,
}

/// A cause in a set, with its amount.
#[derive(Debug, Clone, PartialEq)]
pub struct Blamed {
    /// The cause.
    pub suspect: Suspect,
    /// Its factor less one, and the standard error of that.
    pub amount: [f64; 2],
}

/// A set of causes that would explain the change.
#[derive(Debug, Clone, PartialEq)]
pub struct Explanation {
    /// The causes; empty: nothing happened.
    pub blamed: Vec<Blamed>,
    /// What is left: sum of squares in standard errors.
    pub left: f64,
    score: f64,
}

/// What would explain a comparison.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Explained {
    /// The best sets, best first; more than one: not separable.
    pub sets: Vec<Explanation>,
    /// Sum of squares in standard errors if nothing happened, over how many parameters.
    pub before: (f64, usize),
    /// How many causes were tried.
    pub tried: usize,
    /// Parameters that the best set leaves beyond their intervals.
    pub unexplained: Vec<String>,
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

/// Explains a comparison.
pub fn explain(comparison: &Comparison) -> Explained {
    let rows: Vec<Row> = comparison.pairs.iter().filter_map(row).collect();
    let suspects = suspects(&rows);
    let mut sets: Vec<Explanation> = Vec::new();
    let wide: Vec<usize> = (0..suspects.len())
        .filter(|s| is_wide(&suspects[*s]))
        .collect();
    for chosen in subsets(&wide) {
        let found = grown(&rows, &suspects, &chosen);
        for other in replaced(&found, &suspects) {
            keep(&mut sets, weighed(&rows, &suspects, &other));
        }
        keep(&mut sets, weighed(&rows, &suspects, &found));
    }
    sets.sort_by(|a, b| {
        a.score
            .total_cmp(&b.score)
            .then(a.blamed.len().cmp(&b.blamed.len()))
    });
    let best = sets.first().map_or(0.0, |set| set.score);
    sets.retain(|set| set.score - best <= ALIKE);
    // A set that holds another one with something more tells nothing new.
    let small: Vec<Vec<Suspect>> = sets.iter().map(Explanation::suspects).collect();
    let holds = |a: &[Suspect], b: &[Suspect]| a.len() > b.len() && b.iter().all(|s| a.contains(s));
    sets.retain(|set| !small.iter().any(|other| holds(&set.suspects(), other)));
    Explained {
        before: (square(&rows, &vec![0.0; rows.len()]), rows.len()),
        unexplained: sets
            .first()
            .map_or(Vec::new(), |set| set.unexplained(&rows)),
        tried: suspects.len(),
        sets,
    }
}

fn row(pair: &Pair) -> Option<Row> {
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
fn suspects(rows: &[Row]) -> Vec<Suspect> {
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

fn is_wide(suspect: &Suspect) -> bool {
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
        "gap" | "contact_load" => (
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

fn subsets(wide: &[usize]) -> Vec<Vec<usize>> {
    let mut all = vec![Vec::new()];
    for one in wide {
        let more: Vec<Vec<usize>> = all
            .iter()
            .filter(|set: &&Vec<usize>| set.len() < WIDE)
            .map(|set| [&set[..], &[*one]].concat())
            .collect();
        all.extend(more);
    }
    all
}

/// The set with every further single cause that pays, the best first.
fn grown(rows: &[Row], suspects: &[Suspect], start: &[usize]) -> Vec<usize> {
    let mut set = start.to_vec();
    let score = |set: &[usize]| weighed(rows, suspects, set).score;
    let mut best = score(&set);
    loop {
        let more = (0..suspects.len()).filter(|s| !is_wide(&suspects[*s]) && !set.contains(s));
        let tried = more
            .map(|s| [&set[..], &[s]].concat())
            .map(|set| (score(&set), set));
        match tried.min_by(|a, b| a.0.total_cmp(&b.0)) {
            Some((found, larger)) if found < best => (best, set) = (found, larger),
            _ => return set,
        }
    }
}

/// The set with one of its causes exchanged for any other.
fn replaced(set: &[usize], suspects: &[Suspect]) -> Vec<Vec<usize>> {
    let mut all = Vec::new();
    for k in 0..set.len() {
        for other in (0..suspects.len()).filter(|s| !set.contains(s)) {
            let mut one = set.to_vec();
            one[k] = other;
            all.push(one);
        }
    }
    all
}

fn keep(sets: &mut Vec<Explanation>, set: Explanation) {
    let same = |a: &Explanation| {
        let (a, b) = (a.suspects(), set.suspects());
        a.len() == b.len() && a.iter().all(|s| b.contains(s))
    };
    if !sets.iter().any(same) {
        sets.push(set);
    }
}

/// A set with its amounts by least squares, and its score.
fn weighed(rows: &[Row], suspects: &[Suspect], set: &[usize]) -> Explanation {
    let count = set.len();
    let mut normal = nalgebra::DMatrix::<f64>::zeros(count, count);
    let mut slope = nalgebra::DVector::<f64>::zeros(count);
    let power = |s: usize, i: usize| {
        let found = suspects[set[s]].moves.iter().find(|(row, _)| *row == i);
        found.map_or(0.0, |(_, power)| *power)
    };
    for (i, row) in rows.iter().enumerate() {
        let weight = row.change[1].powi(-2);
        for a in 0..count {
            slope[a] += weight * power(a, i) * row.change[0];
            for b in 0..count {
                normal[(a, b)] += weight * power(a, i) * power(b, i);
            }
        }
    }
    let raised = &normal + nalgebra::DMatrix::from_diagonal(&(normal.diagonal() * 1e-9));
    let inverse = raised.try_inverse();
    // Causes that move the same rows alike cannot stand together: such a set tells nothing.
    let sound = inverse
        .as_ref()
        .is_some_and(|inverse| (0..count).all(|a| inverse[(a, a)] * normal[(a, a)] < 1e4));
    let inverse = inverse.unwrap_or_else(|| nalgebra::DMatrix::zeros(count, count));
    let amounts = &inverse * slope;
    let fitted: Vec<f64> = (0..rows.len())
        .map(|i| (0..count).map(|a| power(a, i) * amounts[a]).sum())
        .collect();
    let left = square(rows, &fitted);
    let (n, m) = (rows.len().max(2) as f64, suspects.len().max(1) as f64);
    let price = count as f64 * (n.ln() + 2.0 * m.ln());
    let blamed = (0..count).map(|a| Blamed {
        suspect: suspects[set[a]].clone(),
        amount: [amounts[a], inverse[(a, a)].max(0.0).sqrt()],
    });
    Explanation {
        blamed: blamed.collect(),
        left,
        score: if sound { left + price } else { f64::INFINITY },
    }
}

fn square(rows: &[Row], fitted: &[f64]) -> f64 {
    let one = |(row, fitted): (&Row, &f64)| ((row.change[0] - fitted) / row.change[1]).powi(2);
    rows.iter().zip(fitted).map(one).sum()
}

impl Explanation {
    fn suspects(&self) -> Vec<Suspect> {
        self.blamed.iter().map(|one| one.suspect.clone()).collect()
    }

    fn fitted(&self, i: usize) -> f64 {
        let of = |one: &Blamed| {
            let found = one.suspect.moves.iter().find(|(row, _)| *row == i);
            found.map_or(0.0, |(_, power)| power * one.amount[0])
        };
        self.blamed.iter().map(of).sum()
    }

    fn unexplained(&self, rows: &[Row]) -> Vec<String> {
        use statrs::distribution::{ContinuousCDF, Normal};
        let normal = Normal::standard();
        let beyond = |(i, row): &(usize, &Row)| {
            let z = (row.change[0] - self.fitted(*i)).abs() / row.change[1];
            2.0 * normal.sf(z) < LEVEL / rows.len() as f64
        };
        let left = rows.iter().enumerate().filter(beyond);
        left.map(|(_, row)| format!("{} of {}", row.name, row.site))
            .collect()
    }
}

impl Blamed {
    /// Whether its amount is a factor on what was there, with its interval in per cent.
    pub fn percent(&self) -> [f64; 3] {
        let [amount, error] = self.amount.map(|v| 100.0 * v);
        [amount, amount - Z95 * error, amount + Z95 * error]
    }
}

#[cfg(test)]
#[path = "compare_causes_tests.rs"]
mod tests;
