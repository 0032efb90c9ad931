//! A channel that stays the same.

use super::{Loaded, Rule};
use crate::fit::suitability::Said;
use crate::fit::suitability::channel;

/// A channel that never changes passes for a load that is not there.
pub const RULE: Rule = Rule {
    name: "dead",
    remedy: "check the cable of that channel, and measure again",
    look,
};

fn look(on: &Loaded) -> Said {
    channel::dead(&on.channels)
}
