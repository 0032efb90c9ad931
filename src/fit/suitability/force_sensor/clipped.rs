//! A channel at the end of its range.

use super::{Rule, Turned};
use crate::fit::suitability::Said;
use crate::fit::suitability::channel;

/// A channel at the end of its range repeats one number while the test goes on.
pub const RULE: Rule = Rule {
    name: "clipped",
    remedy: "measure again with a wider range of that channel",
    look,
};

fn look(on: &Turned) -> Said {
    channel::clipped(&on.channels)
}
