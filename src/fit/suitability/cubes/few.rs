//! Cubes that are missing in a test.

use super::{Loaded, Rule};
use crate::fit::suitability::{Said, Weight};
use std::collections::{BTreeMap, BTreeSet};

/// A file that was cut off holds a last test with fewer cubes than the others.
pub const RULE: Rule = Rule {
    name: "few",
    remedy: "check that the whole file was copied; a cube that was not measured may stay away",
    look,
};

/// Readings with which nothing can be held against anything.
const FEWEST: usize = 3;

fn look(on: &Loaded) -> Said {
    match on.test.readings.len() {
        n if n < FEWEST => vec![(
            Weight::Fatal,
            format!("the file holds {n} of the {FEWEST} readings that a comparison needs"),
        )],
        _ => lost(on),
    }
}

fn lost(on: &Loaded) -> Said {
    let mut cubes: BTreeMap<i64, BTreeSet<usize>> = BTreeMap::new();
    for r in &on.test.readings {
        cubes.entry(r.test).or_default().insert(r.cube);
    }
    let most = cubes.values().map(BTreeSet::len).max().unwrap_or(0);
    let short = cubes.iter().filter(|(_, own)| own.len() < most);
    let short: Vec<String> = short.map(|(test, _)| test.to_string()).collect();
    let mut found = Vec::new();
    if !short.is_empty() {
        let what = format!(
            "tests with fewer cubes than the {most} of the others: {}",
            short.join(", ")
        );
        found.push((Weight::Odd, what));
    }
    let seen: BTreeSet<usize> = on.test.readings.iter().map(|r| r.cube).collect();
    let all = on.test.facts.cubes.iter().enumerate();
    let lost: Vec<&str> = all
        .filter(|(i, _)| !seen.contains(i))
        .map(|(_, c)| c.name.as_str())
        .collect();
    if !lost.is_empty() {
        let what = format!(
            "cubes that the front matter names without a reading: {}",
            lost.join(", ")
        );
        found.push((Weight::Odd, what));
    }
    found
}
