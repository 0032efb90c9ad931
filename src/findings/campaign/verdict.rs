//! The verdict on all experiments on one robot together.

use super::check::{Agreement, Check};
use crate::findings::answer::{Answer, Group, Verdict};
use crate::findings::joint::Joint;

/// The verdict on a whole campaign: one unknown cause anywhere leaves the robot at best partly
/// explained; one that is contradicted elsewhere leaves it open.
///
/// A group that one experiment cannot separate is explained once all together tell its members apart.
pub fn verdict<'a>(
    answers: impl Iterator<Item = &'a Answer>,
    checks: &[Check],
    joint: Option<&Joint>,
) -> Verdict {
    let told = |group: &Group| joint.is_some_and(|joint| joint.told(group).is_some());
    let settled = |answer: &Answer| match answer.verdict {
        Verdict::CannotTell if answer.groups.iter().all(told) => Verdict::Explained,
        verdict => verdict,
    };
    let all: Vec<Verdict> = answers.map(settled).collect();
    let any = |wanted: Verdict| all.contains(&wanted);
    let explained = any(Verdict::Explained) || any(Verdict::PartlyExplained);
    let contradicted = checks
        .iter()
        .any(|check| check.agreement == Agreement::Contradicted);
    match () {
        () if any(Verdict::UnknownCause) && !explained => Verdict::UnknownCause,
        () if any(Verdict::UnknownCause) || any(Verdict::PartlyExplained) => {
            Verdict::PartlyExplained
        }
        () if contradicted => Verdict::PartlyExplained,
        () if explained => Verdict::Explained,
        () if any(Verdict::CannotTell) => Verdict::CannotTell,
        () => Verdict::Sufficient,
    }
}
