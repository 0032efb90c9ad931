//! The gate for hammer tests.

mod dead;
mod given;
mod scale;
mod short;
mod twice;
mod unrelated;

use super::{Doubt, Said};
use crate::fit::suitability::Weight;
use crate::ground::problem::{Outcome, Problem};
use crate::measurement::hammer::HammerRecord;

/// One rule of this kind.
pub type Rule = super::Rule<fn(&HammerRecord) -> Said>;

/// Every rule, in the order in which its findings are said.
pub const RULES: &[Rule] = &[
    short::RULE,
    dead::RULE,
    scale::RULE,
    unrelated::RULE,
    twice::RULE,
];

/// The rules for frequency responses without the hits behind them.
pub const GIVEN: &[Rule] = &[given::RULE];

/// What is odd about a record, the gravest first.
pub fn doubts(record: &HammerRecord) -> Vec<Doubt> {
    let rules = match record.given {
        Some(_) => GIVEN,
        None => RULES,
    };
    super::doubts(rules, |look| look(record))
}

/// Rules whose findings say that the file cannot mean what it says: nothing is computed then.
const MEANINGLESS: &[&str] = &[
    short::RULE.name,
    dead::RULE.name,
    scale::RULE.name,
    given::RULE.name,
];

/// Refuses a record that cannot mean what it says.
///
/// # Errors
/// What makes it so, with the remedy.
pub fn refuse(doubts: &[Doubt]) -> Outcome<()> {
    let grave = |d: &&Doubt| d.weight == Weight::Fatal && MEANINGLESS.contains(&d.rule);
    match doubts.iter().find(grave) {
        Some(doubt) => Err(Problem::new(doubt.what.clone(), doubt.remedy)),
        None => Ok(()),
    }
}
