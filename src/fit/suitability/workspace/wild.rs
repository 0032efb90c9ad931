//! A force that nobody applied.

use super::{Loaded, Rule};
use crate::fit::suitability::{Said, Weight};
use crate::signal::outliers::median;

/// One wild reading of the force turns the line of its set-up.
pub const RULE: Rule = Rule {
    name: "wild-force",
    remedy: "empty that cell, or correct it",
    look,
};

/// Times the median force that no step of a test applies.
const WILD: f64 = 30.0;

fn look(on: &Loaded) -> Said {
    let forces: Vec<f64> = on.test.steps.iter().map(|s| s.force.abs()).collect();
    let applied: Vec<f64> = forces.iter().copied().filter(|f| *f > 0.0).collect();
    let limit = WILD * median(&applied);
    let wild = forces.iter().filter(|f| **f > limit).count();
    match wild {
        0 => Vec::new(),
        n => vec![(
            Weight::Fatal,
            format!(
                "{n} of {} forces are more than {WILD} times the usual one",
                forces.len()
            ),
        )],
    }
}
