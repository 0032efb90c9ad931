//! The accelerations must answer the hit.

use super::Rule;
use crate::fit::suitability::{Said, Weight};
use crate::ground::stats::largest;
use crate::measurement::hammer::{HammerRecord, HammerRun};

/// An acceleration that is the same before and after the hit does not answer it.
pub const RULE: Rule = Rule {
    name: "unrelated",
    remedy: "check which sensor was recorded in this column, and its range",
    look,
};

/// Share of the largest force at which a hit begins.
const BEGINS: f64 = 0.2;
/// Samples before the hit that tell the noise.
const BEFORE: usize = 12;
/// Ratio of the mean squares after and before the hit below which nothing answered.
const ANSWER: f64 = 1.6;

fn look(record: &HammerRecord) -> Said {
    let mut found = Vec::new();
    for (o, name) in record.outputs.iter().enumerate() {
        let ratios: Vec<f64> = record
            .runs
            .iter()
            .filter_map(|run| answer(run, o))
            .collect();
        let silent = ratios.iter().filter(|r| **r < ANSWER).count();
        if !ratios.is_empty() && 2 * silent > ratios.len() {
            let what = format!(
                "the acceleration a{name} is no stronger after the hit than before it in {silent} of {} records",
                ratios.len()
            );
            found.push((Weight::Fatal, what));
        }
    }
    found
}

/// Mean square just after the hit over that before it.
fn answer(run: &HammerRun, output: usize) -> Option<f64> {
    let peak = largest(&run.force);
    let hit = run.force.iter().position(|f| f.abs() > BEGINS * peak)?;
    let begin = hit.saturating_sub(hit / 10 + 2);
    let (before, after) = (
        run.responses[output].get(..begin)?,
        run.responses[output].get(hit..)?,
    );
    if before.len() < BEFORE || run.hit.is_none() {
        return None;
    }
    let after = &after[..after.len().min(10 * before.len().max(40))];
    let level = before.iter().sum::<f64>() / before.len() as f64;
    let power =
        |v: &[f64]| v.iter().map(|x| (x - level).powi(2)).sum::<f64>() / v.len().max(1) as f64;
    Some(power(after) / power(before)).filter(|r| r.is_finite())
}
