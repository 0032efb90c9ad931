//! Channels that stay the same.

use super::Rule;
use crate::fit::suitability::{Said, Weight, extent};
use crate::measurement::hammer::{HammerRecord, HammerRun};

/// A channel that never changes passes for a structure that does not move.
pub const RULE: Rule = Rule {
    name: "dead",
    remedy: "leave the cells of that column empty, or measure again",
    look,
};

fn look(record: &HammerRecord) -> Said {
    let still = |of: &dyn Fn(&HammerRun) -> f64| record.runs.iter().all(|run| of(run) <= 0.0);
    let mut found = Vec::new();
    if still(&|run| extent(&run.force)) {
        found.push((Weight::Fatal, "the force never changes".into()));
    }
    for (o, name) in record.outputs.iter().enumerate() {
        if still(&|run| extent(&run.responses[o])) {
            found.push((
                Weight::Fatal,
                format!("the acceleration a{name} never changes: a dead channel"),
            ));
        }
    }
    found
}
