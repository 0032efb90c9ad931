//! A sensor at the end of its range.

use super::{Loaded, Rule};
use crate::fit::suitability::{Said, Weight, extent, range};
use crate::measurement::workspace_test::{DIRECTIONS, Step};

/// The rule.
pub const RULE: Rule = Rule {
    name: "clipped",
    about: "A sensor at the end of its range repeats one number at different forces.",
    remedy: "measure again with a wider range of that sensor, or with less force",
    look,
};

/// Readings at one extreme that are no coincidence.
const PLATEAU: usize = 4;
/// Share of all distinct readings that is no coincidence of a coarse converter.
const LEVELS: usize = 5;

fn look(on: &Loaded) -> Said {
    let steps = &on.test.steps;
    let mut found = Vec::new();
    for k in 0..3 {
        let values: Vec<f64> = steps.iter().map(|s| s.displacement[k]).collect();
        let (low, high) = range(&values);
        let rows = [low, high]
            .map(|end| at(steps, k, end))
            .into_iter()
            .max()
            .unwrap_or(0);
        let mut levels: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
        levels.sort_by(f64::total_cmp);
        let typical = levels
            .chunk_by(|a, b| a == b)
            .map(<[f64]>::len)
            .filter(|n| *n < rows)
            .max();
        let stands = rows >= PLATEAU && rows >= LEVELS * typical.unwrap_or(1).min(rows);
        if high > low && stands {
            let what = format!(
                "the displacement d{} stands at its extreme in {rows} steps of different force: it is clipped",
                DIRECTIONS[k]
            );
            found.push((Weight::Fatal, what));
        }
    }
    found
}

/// Steps at an extreme, where they are of different force or set-up.
fn at(steps: &[Step], k: usize, end: f64) -> usize {
    let own: Vec<&Step> = steps.iter().filter(|s| s.displacement[k] == end).collect();
    let forces: Vec<f64> = own.iter().map(|s| s.force.abs()).collect();
    let all: Vec<f64> = steps.iter().map(|s| s.force.abs()).collect();
    match extent(&forces) > 0.1 * extent(&all) {
        true => own.len(),
        false => 0,
    }
}
