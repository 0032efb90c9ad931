//! A channel that stays the same.

use super::{Axis, Rule};
use crate::fit::suitability::Said;
use crate::fit::suitability::channel;

/// The rule.
pub const RULE: Rule = Rule {
    name: "dead",
    about: "A scale that never changes passes for an axis that stands still.",
    remedy: "check the cable of that channel, and measure again",
    look,
};

fn look(on: &Axis) -> Said {
    channel::dead(&on.channels)
}
