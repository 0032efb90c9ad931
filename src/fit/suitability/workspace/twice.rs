//! Rows that stand in the file twice.

use super::{Loaded, Rule};
use crate::fit::suitability::{Said, Weight, said_if};
use crate::measurement::workspace_test::Step;

/// A step that is copied counts twice and makes every interval too narrow.
pub const RULE: Rule = Rule {
    name: "twice",
    remedy: "remove the copies",
    look,
};

/// Share of copied steps that is no coincidence.
const MANY: f64 = 0.1;

fn look(on: &Loaded) -> Said {
    let bits = |s: &Step| {
        let numbers = [
            s.force,
            s.displacement[0],
            s.displacement[1],
            s.displacement[2],
        ];
        let place = (s.point, s.direction, s.cycle);
        (place, numbers.map(f64::to_bits))
    };
    let mut all: Vec<_> = on.test.steps.iter().map(bits).collect();
    all.sort_unstable();
    let rows = all.len();
    all.dedup();
    let copies = rows - all.len();
    said_if(
        copies as f64 > MANY * rows as f64,
        Weight::Odd,
        format!("{copies} of {rows} steps are exact copies of others"),
    )
}
