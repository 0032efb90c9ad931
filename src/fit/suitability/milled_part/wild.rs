//! Readings that no part has.

use super::{Probed, Rule};
use crate::fit::suitability::{Said, channel};

/// The rule.
pub const RULE: Rule = Rule {
    name: "wild",
    about: "One absurd reading turns every mean and every fit.",
    remedy: "empty that cell, or correct it",
    look,
};

fn look(on: &Probed) -> Said {
    channel::wild(&on.channels)
}
