//! Lone wild readings of the deflection.

use super::{Course, Rule};
use crate::fit::observation::{MOST_ROWS, Observation};
use crate::fit::suitability::{Said, Weight};

/// Lone wild readings are replaced by their neighbours, and counted.
pub const RULE: Rule = Rule {
    name: "wild-response",
    remedy: "look at the sensor's cable",
    look,
};

fn look(on: &Course) -> Said {
    let file = on.file;
    let wild = Observation::of(file, MOST_ROWS).wild.len();
    match wild {
        0 => Vec::new(),
        1 => vec![(
            Weight::Note,
            "one lone wild reading was replaced by its neighbours".into(),
        )],
        n => vec![(
            Weight::Note,
            format!("{n} lone wild readings were replaced by their neighbours"),
        )],
    }
}
