//! A channel that stays the same.

use super::{Loaded, Rule};
use crate::fit::suitability::{Said, Weight, extent};
use crate::ground::stats::largest;
use crate::measurement::workspace_test::DIRECTIONS;

/// A channel that never changes passes for a direction without compliance.
pub const RULE: Rule = Rule {
    name: "dead",
    remedy: "leave the cells of that column empty, or measure again",
    look,
};

fn look(on: &Loaded) -> Said {
    let values = |k: usize| -> Vec<f64> {
        let all = on.test.steps.iter().map(|s| s.displacement[k]);
        all.filter(|d| !d.is_nan()).collect()
    };
    let dead = (0..3).filter(|k| {
        let own = values(*k);
        own.len() > 2 && extent(&own) <= 1e-12 * largest(&own)
    });
    dead.map(|k| {
        (
            Weight::Fatal,
            format!(
                "the displacement d{} never changes: a dead channel",
                DIRECTIONS[k]
            ),
        )
    })
    .collect()
}
