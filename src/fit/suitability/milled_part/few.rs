//! Places that are too few to tell anything.

use super::{Probed, Rule};
use crate::fit::suitability::{Said, Weight};

/// As many unknowns as places fit anything.
pub const RULE: Rule = Rule {
    name: "few",
    remedy: "probe at least twelve places, on feeds in two directions",
    look,
};

/// Places below which nothing is told.
const LEAST: usize = 12;

fn look(on: &Probed) -> Said {
    match on.test.readings.len() {
        n if n < LEAST => vec![(Weight::Fatal, format!("{n} places were probed"))],
        _ => Vec::new(),
    }
}
