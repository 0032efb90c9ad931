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

/// Share of copied steps that is no coincidence ...
const MANY: f64 = 0.1;
/// ... where they are so many times what a coarse sensor makes of them.
const CHANCE: f64 = 1.5;

fn look(on: &Loaded) -> Said {
    let place = |s: &&Step| (s.point, s.direction, s.cycle, s.force.to_bits());
    let mut all: Vec<&Step> = on.test.steps.iter().collect();
    all.sort_by_key(|s| (place(s), s.displacement.map(f64::to_bits)));
    let (rows, mut pairs, mut same, mut copies) = (all.len(), 0.0, [0.0; 3], 0.0);
    for pair in all
        .windows(2)
        .filter(|pair| place(&pair[0]) == place(&pair[1]))
    {
        let equal = [0, 1, 2].map(|k| alike(pair[0].displacement[k], pair[1].displacement[k]));
        pairs += 1.0;
        same.iter_mut()
            .zip(equal)
            .for_each(|(n, e)| *n += f64::from(u8::from(e)));
        copies += f64::from(u8::from(equal == [true; 3]));
    }
    // components that are read to full steps agree by chance, each by its own
    let chance = same.iter().fold(pairs, |p, n| p * n / f64::max(pairs, 1.0));
    said_if(
        copies > MANY * rows as f64 && copies > CHANCE * chance,
        Weight::Odd,
        format!("{copies} of {rows} steps are exact copies of others"),
    )
}

/// Whether two readings are one number, or neither was taken.
fn alike(a: f64, b: f64) -> bool {
    a == b || a.is_nan() && b.is_nan()
}
