//! A load cycle goes to and fro.

use super::{Course, Rule};
use crate::fit::suitability::{Said, Weight, extent};

/// On a single ramp a gap, friction and drift pass for stiffness; once up and down, what time does and what the
/// load does look alike.
pub const RULE: Rule = Rule {
    name: "part-of-a-cycle",
    remedy: "load to and fro, more than once",
    look,
};

fn look(on: &Course) -> Said {
    let said = match (on.imposed, on.cycles.turning.len()) {
        (false, 0) if on.is_part() => (
            Weight::Fatal,
            "the load goes one way only, with no turning point: too little to tell a response from chance",
        ),
        (false, 1) => (
            Weight::Odd,
            "the load went there and back once: what came with time and what came with the load cannot all be told apart",
        ),
        _ => return Vec::new(),
    };
    vec![(said.0, said.1.into())]
}

impl Course<'_> {
    /// Whether the load changes, and never turns.
    pub fn is_part(&self) -> bool {
        extent(&self.file.load) > 0.0 && self.cycles.turning.is_empty()
    }
}
