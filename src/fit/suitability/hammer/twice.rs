//! Hits that stand in the file twice.

use super::Rule;
use crate::fit::suitability::{Said, Weight};
use crate::measurement::hammer::{HammerRecord, HammerRun};

/// A hit that is copied counts twice and makes every interval too narrow.
pub const RULE: Rule = Rule {
    name: "twice",
    remedy: "remove the copies",
    look,
};

fn look(record: &HammerRecord) -> Said {
    let print = |run: &HammerRun| -> Vec<u64> {
        let force = run.force.iter().take(400).map(|f| f.to_bits());
        let responses = run.responses.iter().flat_map(|r| r.iter().take(400));
        force.chain(responses.map(|a| a.to_bits())).collect()
    };
    let mut all: Vec<Vec<u64>> = record.runs.iter().map(print).collect();
    let runs = all.len();
    all.sort_unstable();
    all.dedup();
    match runs - all.len() {
        0 => Vec::new(),
        copies => vec![(
            Weight::Odd,
            format!("{copies} of {runs} records are exact copies of others"),
        )],
    }
}
