//! The verdict on a campaign in a few sentences.

use crate::cli::diagnose::One;
use crate::findings::Verdict;
use crate::findings::campaign::{Agreement, Check};
use crate::findings::sentence::{place, spoken};
use std::collections::BTreeMap;

/// Places that a sentence can hold.
const LISTED: usize = 3;

/// How many experiments are missed, what was named, and what one says about another.
pub fn sentence(files: &[One], checks: &[Check]) -> String {
    let said = [Some(missed(files)), named(files), open(files), held(checks)];
    said.into_iter().flatten().collect::<Vec<_>>().join(" ")
}

fn missed(files: &[One]) -> String {
    let right = |one: &&One| one.found.answer().verdict == Verdict::Sufficient;
    let (right, wrong): (Vec<&One>, Vec<&One>) = files.iter().partition(right);
    let stems = |all: &[&One]| {
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
fn named(files: &[One]) -> Option<String> {
    let mut found: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for cause in files.iter().flat_map(|one| &one.found.answer().causes) {
        let sites = found.entry(cause.effect).or_default();
        if !sites.contains(&cause.site.as_str()) {
            sites.push(&cause.site);
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

fn open(files: &[One]) -> Option<String> {
    let groups = files.iter().map(|one| one.found.answer().groups.len());
    match groups.sum::<usize>() {
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
