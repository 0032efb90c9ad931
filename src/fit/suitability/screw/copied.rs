//! Rows that stand in the file twice.

use super::{Axis, Rule};
use crate::fit::suitability::{Said, channel};

/// A reading that is copied counts twice and makes every interval too narrow.
pub const RULE: Rule = Rule {
    name: "twice",
    remedy: "remove the copies",
    look,
};

fn look(on: &Axis) -> Said {
    let readings = on.test.readings.iter();
    channel::copied(readings.map(|r| (r.run, r.forward, r.target.to_bits(), r.actual.to_bits())))
}
