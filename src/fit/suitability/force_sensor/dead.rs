//! A channel that stays the same.

use super::{Rule, Turned};
use crate::fit::suitability::{Said, Weight, channel};

/// A channel that never changes passes for a load that is not there.
pub const RULE: Rule = Rule {
    name: "dead",
    remedy: "check the cable of that channel, and measure again",
    look,
};

/// A force changes with the orientation where the weight comes to point along its axis; a moment stays zero where the centre lies on its axis.
fn look(on: &Turned) -> Said {
    let (forces, moments) = on.channels.split_at(3);
    let changing = forces
        .iter()
        .zip(on.changes)
        .filter(|(_, changes)| *changes);
    let mut found: Said = changing
        .flat_map(|(force, _)| channel::dead(std::slice::from_ref(force)))
        .collect();
    let still = moments.iter().filter(|c| channel::is_dead(&c.values));
    let stuck = still.filter(|c| c.values[0] != 0.0);
    found.extend(stuck.map(|c| {
        let what = format!("{} never changes: a dead channel", c.name);
        (Weight::Odd, what)
    }));
    found
}
