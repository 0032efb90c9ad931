//! There must be a load.

use super::{Loaded, Rule};
use crate::fit::suitability::{Said, Weight, said_if};

/// Without a load nothing moves, and noise passes for it.
pub const RULE: Rule = Rule {
    name: "unchanging",
    remedy: "write the load of every reading, loaded less unloaded",
    look,
};

fn look(on: &Loaded) -> Said {
    let none = |r: &crate::measurement::cubes::Reading| r.force == [0.0; 3] && r.moment == [0.0; 3];
    said_if(
        on.test.readings.iter().all(none),
        Weight::Fatal,
        "every load is zero",
    )
}
