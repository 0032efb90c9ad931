//! Readings that nothing made.

use super::{Axis, Rule};
use crate::fit::suitability::Said;
use crate::fit::suitability::channel;

/// The rule.
pub const RULE: Rule = Rule {
    name: "wild",
    about: "One absurd reading turns every mean and every fit.",
    remedy: "empty that cell, or correct it",
    look,
};

fn look(on: &Axis) -> Said {
    channel::wild(&on.channels)
}
