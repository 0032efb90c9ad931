//! One column exported under two titles.

use super::{Course, Rule};
use crate::fit::suitability::{Said, Weight};
use crate::ground::stats::rms;

/// The rule.
pub const RULE: Rule = Rule {
    name: "copied",
    about: "A deflection in exact proportion to the load is the load's own column: no sensor has no error.",
    remedy: "export the sensor's own channel",
    look,
};

/// Levels of the load from which on exact proportion is no chance of few digits.
const LEVELS: usize = 6;
/// What arithmetic of units leaves, of the whole.
const ROUNDING: f64 = 1e-12;

fn look(on: &Course) -> Said {
    let file = on.file;
    let mut levels = file.load.clone();
    levels.sort_by(f64::total_cmp);
    levels.dedup();
    if levels.len() < LEVELS {
        return Vec::new();
    }
    match is_in_proportion(&file.load, &file.deflection) {
        true => vec![(
            Weight::Fatal,
            "the deflection is the load times a number, without any error: one column was exported twice"
                .into(),
        )],
        false => Vec::new(),
    }
}

fn is_in_proportion(load: &[f64], other: &[f64]) -> bool {
    let scale = rms(load).max(f64::MIN_POSITIVE);
    let own: f64 = load.iter().map(|l| (l / scale).powi(2)).sum();
    let cross: f64 = load.iter().zip(other).map(|(l, o)| l / scale * o).sum();
    let off = load.iter().zip(other);
    let off: Vec<f64> = off.map(|(l, o)| o - cross / own * l / scale).collect();
    let size = rms(other);
    size > 0.0 && rms(&off) <= ROUNDING * size
}
