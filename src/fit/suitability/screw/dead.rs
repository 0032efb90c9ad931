//! A channel that stays the same.

use super::{Axis, Rule};
use crate::fit::suitability::Said;
use crate::fit::suitability::channel;

/// A scale that never changes passes for an axis that stands still.
pub const RULE: Rule = Rule {
    name: "dead",
    remedy: "check the cable of that channel, and measure again",
    look,
};

fn look(on: &Axis) -> Said {
    channel::dead(&on.channels)
}
