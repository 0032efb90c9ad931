//! A probe at the end of its range.

use super::{Probed, Rule};
use crate::fit::suitability::channel::is_dead;
use crate::fit::suitability::{Said, channel};

/// A probe at the end of its range repeats one number while the test goes on.
pub const RULE: Rule = Rule {
    name: "clipped",
    remedy: "measure again with a wider range of the probe",
    look,
};

/// A component that is zero throughout was not probed, which is no fault.
fn look(on: &Probed) -> Said {
    let live = on.channels.iter().filter(|c| !is_dead(&c.values));
    live.flat_map(|c| channel::clipped(std::slice::from_ref(c)))
        .collect()
}
