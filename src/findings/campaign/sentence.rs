//! The verdict on a campaign in a few sentences.

use super::check::{Agreement, Check};
use super::{Campaign, DiagnosedFile};
use crate::findings::Verdict;
use crate::findings::sentence::{place, spoken};
use std::collections::BTreeMap;

/// Places that a sentence can hold.
const LISTED: usize = 3;

/// How many experiments are missed, what was named, and what one says about another.
pub fn sentence(campaign: &Campaign) -> String {
    let said = [
        Some(missed(&campaign.files)),
        named(campaign),
        open(campaign),
        held(&campaign.checks),
    ];
    said.into_iter().flatten().collect::<Vec<_>>().join(" ")
}

fn missed(files: &[DiagnosedFile]) -> String {
    let right = |one: &&DiagnosedFile| one.found.answer().verdict == Verdict::Sufficient;
    let (right, wrong): (Vec<&DiagnosedFile>, Vec<&DiagnosedFile>) = files.iter().partition(right);
    let stems = |all: &[&DiagnosedFile]| {
        all.iter()
            .map(|one| one.stem())
            .collect::<Vec<_>>()
            .join(", ")
    };
    let (n, all) = (wrong.len(), files.len());
    if all == 1 && n == 1 {
        return "The simulation misses the only experiment.".into();
    }
    let which = match (n, right.len()) {
        (0, _) => {
            return format!(
                "The simulation agrees with all {all} experiments to within their noise."
            );
        }
        (_, 0) => String::new(),
        (_, few) if few < n && few <= LISTED => format!(", all but {}", stems(&right)),
        _ => format!(": {}", stems(&wrong)),
    };
    format!("The simulation misses {n} of {all} experiments{which}.")
}

/// `Named: backlash at 12 places, joint damping at A4.`
fn named(campaign: &Campaign) -> Option<String> {
    let answers = campaign.files.iter().map(|one| one.found.answer());
    let causes = answers.clone().flat_map(|answer| &answer.causes);
    let alone = causes.map(|cause| (cause.effect, cause.site.clone()));
    let groups = answers.flat_map(|answer| &answer.groups);
    let together = groups.filter_map(|group| Some(campaign.told(group)?.0));
    let mut found: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    for (effect, site) in alone.chain(together) {
        let sites = found.entry(effect).or_default();
        if !sites.contains(&site) {
            sites.push(site);
        }
    }
    let said = found.iter().map(|(effect, sites)| match sites.len() {
        n if n > LISTED => format!("{} at {n} places", spoken(effect)),
        _ => {
            let places: Vec<String> = sites.iter().map(|site| place(site)).collect();
            format!("{} at {}", spoken(effect), places.join(" and "))
        }
    });
    let said: Vec<String> = said.collect();
    (!said.is_empty()).then(|| format!("Named: {}.", said.join(", ")))
}

fn open(campaign: &Campaign) -> Option<String> {
    let files = campaign.files.iter();
    let groups = files.flat_map(|one| &one.found.answer().groups);
    match groups
        .filter(|group| campaign.told(group).is_none())
        .count()
    {
        0 => None,
        1 => Some("One question is open.".into()),
        n => Some(format!("{n} questions are open.")),
    }
}

fn held(checks: &[Check]) -> Option<String> {
    let count = |wanted| checks.iter().filter(|c| c.agreement == wanted).count();
    match (count(Agreement::Confirmed), count(Agreement::Contradicted)) {
        (0, 0) => None,
        (good, bad) => Some(format!(
            "Of what one experiment predicts for another, {good} predictions are confirmed and {bad} contradicted."
        )),
    }
}
