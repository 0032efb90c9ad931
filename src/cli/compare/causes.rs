//! What would explain a change, in words and as JSON.

use crate::fit::compare::Comparison;
use crate::fit::compare_causes::{Blamed, Explained, Explanation, explain};
use crate::report::json::number;
use crate::sheet::number::significant;
use serde_json::{Value, json};

/// The sentences, the verdict first; none where nothing was judged.
pub fn sentences(comparison: &Comparison) -> Vec<String> {
    let found = explain(comparison);
    let Some(best) = found.sets.first() else {
        return Vec::new();
    };
    let mut said = vec![head(&found, best)];
    said.extend(best.blamed.iter().map(told));
    let others = found.sets.iter().skip(1);
    let others: Vec<String> = others.map(|set| format!("or {}", named(set))).collect();
    if !others.is_empty() {
        said.push(format!(
            "Not separable by these fits: {}, {}.",
            named(best),
            others.join(", ")
        ));
        said.extend(advice(&found));
    }
    if !found.unexplained.is_empty() {
        said.push(format!(
            "Left beyond its intervals by every cause that is known: {}.",
            found.unexplained.join(", ")
        ));
    }
    said
}

fn head(found: &Explained, best: &Explanation) -> String {
    let (before, count) = found.before;
    let (before, left) = (significant(before, 3), significant(best.left, 3));
    match best.blamed.is_empty() {
        true => format!(
            "No cause is needed: {count} changes add up to {before} squared standard errors ({} causes tried).",
            found.tried
        ),
        false => format!(
            "What would explain it: {}. {count} changes add up to {before} squared standard errors without, {left} with it ({} causes tried).",
            named(best),
            found.tried
        ),
    }
}

fn named(set: &Explanation) -> String {
    let names: Vec<String> = set.blamed.iter().map(name).collect();
    match names.is_empty() {
        true => "nothing".into(),
        false => names.join(" and "),
    }
}

fn name(one: &Blamed) -> String {
    let cause = one.suspect.cause.map_or("no known cause", |cause| cause);
    match one.suspect.site.is_empty() {
        true => cause.into(),
        false => format!("{cause} at {}", one.suspect.site),
    }
}

fn told(one: &Blamed) -> String {
    let [amount, low, high] = one.percent().map(|v| significant(v, 2));
    let (name, says) = (name(one), &one.suspect.says);
    format!("{name}: {says}; {amount} % [{low}, {high}] of the mean of both sides.")
}

/// What would tell instruments apart.
fn advice(found: &Explained) -> Option<String> {
    let blamed = || found.sets.iter().flat_map(|set| &set.blamed);
    let has = |name: &str| blamed().any(|one| one.suspect.cause == Some(name));
    (has("force_gain") || has("sensor_gain")).then(|| {
        "A gap or another displacement on both sides tells a force from a sensor; the same load on a known spring tells both from the robot.".into()
    })
}

/// The same as JSON.
pub fn json(comparison: &Comparison) -> Value {
    let found = explain(comparison);
    let blamed = |one: &Blamed| {
        let [amount, low, high] = one.percent();
        json!({
            "cause": one.suspect.cause,
            "site": one.suspect.site,
            "meaning": one.suspect.says,
            "percent": number(amount),
            "percent_ci95": [number(low), number(high)],
        })
    };
    let set = |set: &Explanation| json!({"causes": set.blamed.iter().map(blamed).collect::<Value>(), "left": number(set.left)});
    json!({
        "sets": found.sets.iter().map(set).collect::<Value>(),
        "separable": found.sets.len() < 2,
        "without": number(found.before.0),
        "parameters": found.before.1,
        "tried": found.tried,
        "unexplained": found.unexplained,
    })
}
