//! A channel that stays the same.

use super::{Moving, Rule};
use crate::fit::suitability::Said;
use crate::fit::suitability::channel;

/// Without both angles and the torque there is no twist and nothing that makes it.
pub const RULE: Rule = Rule {
    name: "dead",
    remedy: "check the channel, or take the columns of that joint out",
    look,
};

fn look(on: &Moving) -> Said {
    channel::dead(&on.channels)
}
