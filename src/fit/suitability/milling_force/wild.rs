//! Readings that nothing made.

use super::{Cutting, Rule};
use crate::fit::suitability::Said;
use crate::fit::suitability::channel;

/// One absurd reading turns every mean and every fit.
pub const RULE: Rule = Rule {
    name: "wild",
    remedy: "empty that cell, or correct it",
    look,
};

fn look(on: &Cutting) -> Said {
    channel::wild(&on.channels)
}
