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
    match on.is_part() && !on.imposed {
        true => vec![(
            Weight::Fatal,
            format!(
                "the load goes to and fro with {} turning points: too few to tell a response from chance",
                on.cycles.turning.len()
            ),
        )],
        false => Vec::new(),
    }
}

/// Turning points of a load that went to and fro.
const TURNS: usize = 2;

impl Course<'_> {
    /// Whether the load changes, and does not go to and fro.
    pub fn is_part(&self) -> bool {
        extent(&self.file.load) > 0.0 && self.cycles.turning.len() < TURNS
    }
}
