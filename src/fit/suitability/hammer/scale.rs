//! Units: force of a hit, and acceleration per force.

use super::Rule;
use crate::fit::suitability::{Said, Weight};
use crate::ground::stats::largest;
use crate::measurement::hammer::{HammerRecord, HammerRun};
use crate::sheet::number::{engineering, significant};
use crate::signal::judge::FORCE_N;
use crate::signal::outliers::median;

/// A hammer hits with some hundred newtons, and a robot answers as some kilograms to some tonnes do.
pub const RULE: Rule = Rule {
    name: "scale",
    remedy: "check the units at the ends of the column names",
    look,
};

/// Peaks of a hit, N.
const FORCES: std::ops::RangeInclusive<f64> = 0.3..=FORCE_N;
/// Peak acceleration per peak force, 1/kg.
const PER_FORCE: std::ops::RangeInclusive<f64> = 5e-5..=5.0;

fn look(record: &HammerRecord) -> Said {
    let answer = |run: &HammerRun| run.responses.iter().map(|r| largest(r)).fold(0.0, f64::max);
    let forces: Vec<f64> = record.runs.iter().map(|run| largest(&run.force)).collect();
    let force = median(&forces);
    let ratios = record.runs.iter().zip(&forces).filter(|(_, f)| **f > 0.0);
    let ratio = median(&ratios.map(|(run, f)| answer(run) / f).collect::<Vec<_>>());
    let mut found = Vec::new();
    if force > 0.0 && !FORCES.contains(&force) {
        let what = format!(
            "hits peak at {}, which no hammer does",
            engineering(force, 3, "N")
        );
        found.push((Weight::Fatal, what));
    }
    if ratio > 0.0 && !PER_FORCE.contains(&ratio) {
        let what = format!(
            "the robot answers a hit as {} kg would",
            significant(1.0 / ratio, 2)
        );
        found.push((Weight::Fatal, what));
    }
    found
}
