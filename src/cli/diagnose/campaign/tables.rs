//! The tables of a campaign.

use super::errors;
use crate::cli::diagnose::page;
use crate::cli::diagnose::tables::{amounts, reduction};
use crate::findings::Cause;
use crate::findings::campaign::Campaign;
use crate::findings::joint::Joint;
use crate::findings::sentence::{candidates, place, probability, spoken};
use crate::sheet::number::{engineering, significant};
use crate::sheet::table::Table;

/// One line per file.
pub fn overview(campaign: &Campaign) -> Table {
    let header = [
        "experiment",
        "verdict",
        "error",
        "noise",
        "error / noise",
        "with causes",
    ];
    let title = "What each experiment says";
    let mut table = Table::new(title, header).numeric([2, 3, 4, 5]);
    for one in &campaign.files {
        let answer = one.found.answer();
        let (error, noise) = (answer.discrepancy.rms, answer.discrepancy.noise_rms);
        let after = errors::held_out(answer);
        table.push([
            one.stem(),
            page::spoken(answer.verdict).to_string(),
            engineering(error, 3, answer.unit),
            engineering(noise, 2, answer.unit),
            significant(error / noise, 2),
            after.map_or(String::new(), |after| engineering(after, 3, answer.unit)),
        ]);
    }
    table.noted("error: rms of measured − simulated; with causes: of that what is left on data held out of the fit")
}

/// Every cause that was named and every question left open, with how sure and what it gained.
pub fn causes(campaign: &Campaign) -> Table {
    let header = [
        "cause",
        "amount",
        "experiment",
        "probability",
        "reduction [95 %]",
    ];
    let mut table = Table::new("Causes, and what each gained", header).numeric([3, 4]);
    for one in &campaign.files {
        let answer = one.found.answer();
        for cause in &answer.causes {
            table.push([
                format!("{} at {}", spoken(cause.effect), place(&cause.site)),
                amount(cause),
                one.stem(),
                probability(cause.probability),
                reduction(&cause.gain),
            ]);
        }
        for group in &answer.groups {
            table.push([
                candidates(group),
                String::new(),
                one.stem(),
                "not told apart".into(),
                reduction(&group.gain),
            ]);
        }
    }
    table.noted("reduction: of the error on data held out of the fit, by naming the cause, with its 95 % interval")
}

/// The leading amount of a cause; the others stand with its experiment.
fn amount(cause: &Cause) -> String {
    let leading = Cause {
        parameters: cause.parameters.iter().take(1).copied().collect(),
        ..cause.clone()
    };
    amounts(&leading)
}

/// Causes as the tests of the whole robot see them alone and together.
pub fn together(joint: &Joint) -> Table {
    let header = ["cause".to_string()].into_iter();
    let header = header.chain(joint.tests.iter().cloned());
    let header = header.chain(["together".to_string()]);
    let mut table = Table::new("All tests of the whole robot together", header);
    table = table.numeric(1..2 + joint.tests.len());
    for cause in &joint.causes {
        let (effect, site) = &cause.place;
        let alone = cause.alone.iter();
        let alone = alone.map(|p| p.map_or("not seen".into(), probability));
        let named = format!("{} at {}", spoken(effect), place(site));
        let line = [named].into_iter().chain(alone);
        table.push(line.chain([probability(cause.probability)]));
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
            spoken(&check.causes.join(", ")),
            check.against.clone(),
            engineering(check.before, 3, check.unit),
            engineering(check.after, 3, check.unit),
            check.word().to_string(),
        ]);
    }
    table.noted("nothing was fitted to the experiment it is held against")
}
