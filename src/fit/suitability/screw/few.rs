//! A run that was broken off, or a file that holds next to nothing.

use super::{Axis, Rule};
use crate::fit::suitability::{Said, Weight};
use std::collections::BTreeMap;

/// A file that was cut off holds runs with fewer readings than the others, and two places of an axis tell no shape.
pub const RULE: Rule = Rule {
    name: "few",
    remedy: "check that the whole file was copied, and measure at three targets or more along the axis",
    look,
};

/// Share of the usual number of readings below which a run is broken off.
const BROKEN_OFF: f64 = 0.75;
/// Targets without which an axis has no shape.
const FEWEST: usize = 3;

fn look(on: &Axis) -> Said {
    let targets = on.test.readings.iter().map(|r| r.target);
    let mut targets: Vec<f64> = targets.collect();
    targets.sort_by(f64::total_cmp);
    targets.dedup();
    match targets.len() < FEWEST {
        true => vec![(
            Weight::Fatal,
            format!(
                "the axis stood at {} of the {FEWEST} targets that a shape needs",
                targets.len()
            ),
        )],
        false => broken_off(on),
    }
}

fn broken_off(on: &Axis) -> Said {
    let mut counts: BTreeMap<(i64, bool), usize> = BTreeMap::new();
    for r in &on.test.readings {
        *counts.entry((r.run, r.forward)).or_default() += 1;
    }
    let mut sorted: Vec<usize> = counts.values().copied().collect();
    sorted.sort_unstable();
    let usual = sorted.get(sorted.len() / 2).copied().unwrap_or(0);
    let mut runs: Vec<i64> = counts.keys().map(|key| key.0).collect();
    runs.dedup();
    let both = counts.keys().any(|k| k.1) && counts.keys().any(|k| !k.1);
    let short = |run: &i64| {
        let of = |way: bool| counts.get(&(*run, way)).copied();
        let broken = |n: usize| (n as f64) < BROKEN_OFF * usual as f64;
        [true, false]
            .into_iter()
            .any(|way| of(way).map_or(both, broken))
    };
    let short: Vec<String> = runs
        .iter()
        .filter(|r| short(r))
        .map(i64::to_string)
        .collect();
    match short.is_empty() || 2 * short.len() > runs.len() {
        true => Vec::new(),
        false => vec![(
            Weight::Odd,
            format!(
                "runs with fewer readings than the usual {usual}: {}",
                short.join(", ")
            ),
        )],
    }
}
