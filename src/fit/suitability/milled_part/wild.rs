//! Readings that no part has.

use super::{Probed, Rule};
use crate::fit::suitability::{Said, channel};

/// One absurd reading turns every mean and every fit.
pub const RULE: Rule = Rule {
    name: "wild",
    remedy: "empty that cell, or correct it",
    look,
};

fn look(on: &Probed) -> Said {
    channel::wild(&on.channels)
}
