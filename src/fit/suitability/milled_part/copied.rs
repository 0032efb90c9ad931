//! Rows that stand in the file twice.

use super::{Probed, Rule};
use crate::fit::suitability::{Said, channel};
use crate::measurement::milled_part::At;

/// A reading that is copied counts twice and makes every interval too narrow.
pub const RULE: Rule = Rule {
    name: "twice",
    remedy: "remove the copies",
    look,
};

fn look(on: &Probed) -> Said {
    let place = |at: At| match at {
        At::Along(s) => [s, 0.0, 0.0],
        At::Place(place) => place,
    };
    let readings = on.test.readings.iter();
    channel::copied(
        readings.map(|r| (place(r.at).map(f64::to_bits), r.deviation.map(f64::to_bits))),
    )
}
