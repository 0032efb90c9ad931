//! Rows that stand in the file twice.

use super::{Loaded, Rule};
use crate::fit::suitability::{Said, channel};

/// A reading that is copied counts twice and makes every interval too narrow.
pub const RULE: Rule = Rule {
    name: "twice",
    remedy: "remove the copies",
    look,
};

fn look(on: &Loaded) -> Said {
    let readings = on.test.readings.iter();
    channel::copied(readings.map(|r| (r.test, r.cube, r.moved.map(f64::to_bits))))
}
