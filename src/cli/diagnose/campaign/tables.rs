//! The tables of a campaign.

use super::{Campaign, errors};
use crate::findings::Answer;
use crate::findings::campaign::named;
use crate::findings::joint::Joint;
use crate::findings::sentence::probability;
use crate::sheet::number::engineering;
use crate::sheet::table::Table;

/// One line per file.
pub fn overview(campaign: &Campaign) -> Table {
    let header = [
        "experiment",
        "verdict",
        "causes",
        "error",
        "noise",
        "with causes",
    ];
    let mut table = Table::new("What each experiment says", header).numeric([3, 4, 5]);
    for one in &campaign.files {
        table.push(line(&one.stem(), one.found.answer()));
    }
    table.noted("error: rms of measured − simulated; with causes: on data held out of the fit; groups that cannot be told apart stand with their first member and a question mark")
}

/// Causes as the tests of the whole robot see them alone and together.
pub fn together(joint: &Joint) -> Table {
    let header = ["cause", "site"].map(String::from).into_iter();
    let header = header.chain(joint.tests.iter().cloned());
    let header = header.chain(["together".to_string()]);
    let mut table = Table::new("All tests of the whole robot together", header);
    table = table.numeric(2..3 + joint.tests.len());
    for cause in &joint.causes {
        let alone = cause
            .alone
            .iter()
            .map(|p| p.map_or("not seen".into(), probability));
        let line = [cause.place.0.to_string(), cause.place.1.clone()].into_iter();
        table.push(line.chain(alone).chain([probability(cause.probability)]));
    }
    table.noted("probability that the cause is present, by each test alone and with the evidence of all multiplied; not seen: the test would not show it")
}

/// What one experiment found, held against the others.
pub fn checked(campaign: &Campaign) -> Table {
    let header = [
        "found in",
        "causes",
        "held against",
        "error before",
        "error after",
        "the prediction is",
    ];
    let mut table =
        Table::new("What one experiment found, predicted for another", header).numeric([3, 4]);
    for check in &campaign.checks {
        table.push([
            check.from.clone(),
            check.causes.join(", "),
            check.against.clone(),
            engineering(check.before, 3, check.unit),
            engineering(check.after, 3, check.unit),
            check.word().to_string(),
        ]);
    }
    table.noted("nothing was fitted to the experiment it is held against")
}

fn line(stem: &str, answer: &Answer) -> [String; 6] {
    let after = errors::held_out(answer);
    let unsure = answer
        .groups
        .iter()
        .filter_map(|g| g.effects.first().map(|e| format!("{e}?")));
    let causes: Vec<String> = match answer.groups.is_empty() {
        true => named(answer),
        false => answer
            .causes
            .iter()
            .map(|c| format!("{} at {}", c.effect, c.site))
            .chain(unsure)
            .collect(),
    };
    [
        stem.to_string(),
        answer.verdict.name().to_string(),
        causes.join(", "),
        engineering(answer.discrepancy.rms, 3, answer.unit),
        engineering(answer.discrepancy.noise_rms, 2, answer.unit),
        after.map_or(String::new(), |after| engineering(after, 3, answer.unit)),
    ]
}
