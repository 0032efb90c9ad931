//! How an answer compares with the truth.

use super::case::{Case, Truth};
use super::judge::{Answer, Named};

#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Score {
    /// The truth and nothing else, nothing left open.
    Exact,
    /// The truth, or a group of at most three that holds it, and nothing else.
    Covered,
    /// The truth, and a cause that is none.
    Extra,
    /// In a group of more than three, and nothing wrong.
    Wide,
    /// Not found, and nothing wrong said.
    Missed,
    /// Not found, and a wrong cause named.
    Wrong,
    /// No answer.
    Failed,
}

pub const SCORES: [Score; 7] = [
    Score::Exact,
    Score::Covered,
    Score::Extra,
    Score::Wide,
    Score::Missed,
    Score::Wrong,
    Score::Failed,
];

const WIDEST: usize = 3;

fn is(truth: &Truth, named: &Named) -> bool {
    truth.effect == named.0 && truth.at(&named.1)
}

/// Structure is left that the program could not name.
pub fn unknown(answer: &Answer) -> bool {
    matches!(
        answer.verdict.as_str(),
        "unknown-cause" | "partly-explained"
    )
}

/// Causes that stand for no group: in an explained answer a member of each group is among them.
fn alone(answer: &Answer) -> Vec<&Named> {
    let grouped = |c: &&Named| answer.groups.iter().any(|g| g.contains(*c));
    answer.causes.iter().filter(|c| !grouped(c)).collect()
}

pub fn score(case: &Case, answer: &Answer) -> Score {
    if answer.failed.is_some() {
        return Score::Failed;
    }
    let mut open: Vec<&Truth> = case.truths.iter().collect();
    let (mut stray, mut wide) = (0, 0);
    for cause in alone(answer) {
        match open.iter().position(|t| is(t, cause)) {
            Some(k) => drop(open.remove(k)),
            None => stray += 1,
        }
    }
    for group in &answer.groups {
        let held = open.iter().position(|t| group.iter().any(|n| is(t, n)));
        match held {
            Some(k) => {
                open.remove(k);
                wide += usize::from(group.len() > WIDEST);
            }
            None => stray += 1,
        }
    }
    match (open.is_empty(), stray, wide) {
        (true, 0, 0) if answer.groups.is_empty() && !unknown(answer) => Score::Exact,
        (true, 0, 0) => Score::Covered,
        (true, 0, _) => Score::Wide,
        (true, ..) => Score::Extra,
        (false, 0, _) => Score::Missed,
        (false, ..) => Score::Wrong,
    }
}

/// Every truth's place is named, by whatever effect, alone or in a group of at most three.
pub fn place_right(case: &Case, answer: &Answer) -> bool {
    let narrow = answer.groups.iter().filter(|g| g.len() <= WIDEST);
    let named: Vec<&Named> = alone(answer).into_iter().chain(narrow.flatten()).collect();
    let found = |t: &Truth| match t.sites.is_empty() {
        true => named.iter().any(|n| n.0 == t.effect),
        false => named.iter().any(|n| t.at(&n.1)),
    };
    case.truths.iter().all(found)
}

/// Anything but "the simulation is right".
pub fn alarm(answer: &Answer) -> bool {
    answer.failed.is_none() && answer.verdict != "sufficient"
}

/// The answer in a word: causes, groups, and the verdict where it says that something is left.
pub fn in_words(answer: &Answer) -> String {
    if let Some(why) = &answer.failed {
        return format!("FAILED ({})", why.lines().next().unwrap_or_default());
    }
    let one = |n: &Named| format!("{}@{}", n.0, n.1);
    let mut parts: Vec<String> = alone(answer).into_iter().map(one).collect();
    for group in &answer.groups {
        let members: Vec<String> = group.iter().map(one).collect();
        parts.push(format!("{{{}}}", members.join("|")));
    }
    if unknown(answer) || parts.is_empty() {
        parts.push(answer.verdict.to_uppercase());
    }
    parts.join(" + ")
}

/// Effects without places, for the confusion matrix.
pub fn in_effects(answer: &Answer) -> String {
    if answer.failed.is_some() {
        return "FAILED".into();
    }
    let mut parts: Vec<String> = alone(answer).iter().map(|n| n.0.clone()).collect();
    for group in &answer.groups {
        let mut members: Vec<&str> = group.iter().map(|n| n.0.as_str()).collect();
        members.sort_unstable();
        members.dedup();
        parts.push(format!("{{{}}}", members.join("/")));
    }
    if unknown(answer) || parts.is_empty() {
        parts.push(answer.verdict.to_uppercase());
    }
    parts.join("+")
}
