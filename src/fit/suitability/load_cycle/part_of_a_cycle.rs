//! A load cycle goes to and fro.

use super::{Course, Rule};
use crate::fit::suitability::{Said, Weight, extent};

/// The rule.
pub const RULE: Rule = Rule {
    name: "part-of-a-cycle",
    about: "On a single ramp a gap, friction and drift pass for stiffness.",
    remedy: "load to and fro, past both turning points",
    look,
};

fn look(on: &Course) -> Said {
    let file = on.file;
    let turning = on.cycles.turning.len();
    match turning < 2 && extent(&file.load) > 0.0 && !on.imposed {
        true => vec![(
            Weight::Fatal,
            "fewer than two turning points: this is no full load cycle".into(),
        )],
        false => Vec::new(),
    }
}
