//! Whether data can carry a number at all. Every verb passes this gate before it says `identified`,
//! `explained` or `sufficient`.
//!
//! One rule is one file and one line in the table of its kind (`RULES` of each module here): what it finds odd, how
//! grave that is, and what to do about it. Rules about single channels stand in [`channel`]. What a rule finds is a
//! [`Doubt`].

pub mod agreement;
pub mod bent;
pub mod channel;
pub mod cubes;
mod follows;
pub mod force_sensor;
pub mod hammer;
pub mod joint_motion;
pub mod load_cycle;
pub mod magnitude;
pub mod milled_part;
pub mod milling_force;
pub mod relation;
pub mod screw;
pub mod workspace;

use crate::ground::problem::{Outcome, Problem};
use crate::robot::load::load;
use serde::Serialize;
use std::path::Path;

/// How grave a doubt is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Weight {
    /// Worth knowing; no number suffers.
    Note,
    /// Needs attention: a number may be another than it seems.
    Odd,
    /// No number and no cause follows from these data.
    Fatal,
}

/// One rule of the gate; `L` is the function that looks at a kind of measurement.
pub struct Rule<L> {
    /// Its name, as in the JSON.
    pub name: &'static str,
    /// What to do about what it finds, imperative.
    pub remedy: &'static str,
    /// What it finds: how grave, and one clause each.
    pub look: L,
}

/// What a rule found; printed as it stands (`formats.md`, section 3).
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Doubt {
    /// Name of the rule.
    pub rule: &'static str,
    /// How grave.
    pub weight: Weight,
    /// What is odd, one clause, lower case.
    pub what: String,
    /// What to do about it.
    pub remedy: &'static str,
}

impl Doubt {
    /// What is odd and what to do about it.
    pub fn sentence(&self) -> String {
        match self.weight {
            Weight::Note => self.what.clone(),
            Weight::Odd | Weight::Fatal => format!("{}: {}", self.what, self.remedy),
        }
    }
}

/// What a rule says: how grave, and what is odd.
pub type Said = Vec<(Weight, String)>;

/// What a rule says that finds one thing or nothing.
pub(crate) fn said_if(odd: bool, weight: Weight, what: impl Into<String>) -> Said {
    odd.then(|| (weight, what.into())).into_iter().collect()
}

/// A robot that a file names, and nobody knows.
pub(crate) fn strange_robot(robot: Option<&String>, file: &Path) -> Said {
    let strange = robot.filter(|name| load(name, Some(file)).is_err());
    let what = |name: &String| format!("the robot `{name}` is not known here");
    strange
        .map(|name| (Weight::Note, what(name)))
        .into_iter()
        .collect()
}

/// What a table of rules finds when each is called, the gravest first.
pub fn doubts<L: Copy>(rules: &[Rule<L>], call: impl Fn(L) -> Said) -> Vec<Doubt> {
    let of = |rule: &Rule<L>| {
        let (name, remedy) = (rule.name, rule.remedy);
        let doubt = move |(weight, what)| Doubt {
            rule: name,
            weight,
            what,
            remedy,
        };
        call(rule.look).into_iter().map(doubt).collect::<Vec<_>>()
    };
    let mut all: Vec<Doubt> = rules.iter().flat_map(of).collect();
    all.sort_by_key(|doubt| std::cmp::Reverse(doubt.weight));
    all
}

/// Whether no number follows from these data.
pub fn is_fatal(doubts: &[Doubt]) -> bool {
    doubts.iter().any(|doubt| doubt.weight == Weight::Fatal)
}

/// Whether anything needs attention.
pub fn is_odd(doubts: &[Doubt]) -> bool {
    doubts.iter().any(|doubt| doubt.weight >= Weight::Odd)
}

/// Refuses data that can carry no number, for verbs that have nothing else to tell.
///
/// # Errors
/// The gravest doubt, where it is fatal, with its remedy.
pub fn refuse(file: &Path, doubts: &[Doubt]) -> Outcome<()> {
    match doubts.iter().find(|doubt| doubt.weight == Weight::Fatal) {
        None => Ok(()),
        Some(doubt) => Err(Problem::new(doubt.what.clone(), doubt.remedy).in_text(file)),
    }
}

/// Smallest and largest; an empty range is upside down.
pub(crate) fn range(values: &[f64]) -> (f64, f64) {
    let start = (f64::INFINITY, f64::NEG_INFINITY);
    values
        .iter()
        .filter(|v| v.is_finite())
        .fold(start, |(l, h), v| (l.min(*v), h.max(*v)))
}

/// Largest less smallest; 0 for no values.
pub(crate) fn extent(values: &[f64]) -> f64 {
    let (low, high) = range(values);
    (high - low).max(0.0)
}
