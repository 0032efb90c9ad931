//! A probe that stays the same.

use super::{Probed, Rule};
use crate::fit::suitability::channel;
use crate::fit::suitability::{Said, Weight, said_if};

/// A part whose every component never changes was not probed.
pub const RULE: Rule = Rule {
    name: "dead",
    remedy: "check the cable of the probe, and measure again",
    look,
};

fn look(on: &Probed) -> Said {
    let dead = on.channels.iter().all(|c| channel::is_dead(&c.values));
    said_if(
        dead && !on.channels.is_empty(),
        Weight::Fatal,
        "no component ever changes: a dead probe",
    )
}
