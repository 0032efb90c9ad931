//! From a chosen set to causes, groups and the verdict.

use super::bank::Bank;
use super::judgement::Judgement;
use super::posterior::Posterior;
use super::rest::Rest;
use super::search::Scored;
use super::statement::{Blamed, Experiment};
use crate::findings::answer::{Cause, Group, Verdict};
use crate::findings::gain::Gain;

/// Causes and groups of a set.
#[derive(Debug, Clone, Default)]
pub struct Named {
    /// In order of gain.
    pub causes: Vec<Cause>,
    /// What cannot be told apart.
    pub groups: Vec<Group>,
}

/// Most members of a group: beyond, the data tell nothing.
const LARGEST_GROUP: usize = 6;

/// Names the causes of a set; `gains` and `blamed` in the order of its suspects.
pub fn name(
    experiment: &dyn Experiment,
    bank: &Bank,
    posterior: &Posterior,
    set: &Scored,
    (blamed, gains): (&[Blamed], &[Gain]),
    judgement: &Judgement,
) -> Named {
    let mut named = Named::default();
    for (at, suspect) in set.suspects.iter().enumerate() {
        let own = &bank.suspects[*suspect];
        if !own.named {
            continue;
        }
        let mut rivals = posterior.stand_ins(set, *suspect);
        rivals.retain(|r| r.1 > judgement.ambiguous && bank.suspects[r.0].named);
        rivals.truncate(LARGEST_GROUP - 1);
        let total: f64 = 1.0 + rivals.iter().map(|r| r.1).sum::<f64>();
        rivals.truncate(carrying(&rivals, judgement.group_carries * total));
        if !rivals.is_empty() {
            let members = std::iter::once(*suspect).chain(rivals.iter().map(|r| r.0));
            let members = members.map(|s| (bank.suspects[s].effect, bank.suspects[s].site.clone()));
            let rivals: Vec<(&'static str, String)> = members.collect();
            named.groups.push(Group {
                would_tell: experiment.would_tell(&rivals),
                effects: rivals.iter().map(|r| r.0).collect(),
                sites: rivals.into_iter().map(|r| r.1).collect(),
                gain: gains[at],
            });
            continue;
        }
        let probability = (posterior.inclusion(*suspect) / total).min(judgement.certain);
        named.causes.push(Cause {
            effect: own.effect,
            site: own.site.clone(),
            probability,
            summary: own.summary,
            alternatives: alternatives(bank, posterior, set, *suspect),
            parameters: experiment.parameters(&blamed[at]),
            gain: gains[at],
        });
    }
    let by_gain = |a: &Cause, b: &Cause| {
        b.gain
            .reduction_percent
            .total_cmp(&a.gain.reduction_percent)
    };
    named.causes.sort_by(by_gain);
    named
}

/// How many rivals, best first, carry so much together with the named cause, whose odds are one.
fn carrying(rivals: &[(usize, f64)], wanted: f64) -> usize {
    let before = |i: &usize| 1.0 + rivals[..*i].iter().map(|r| r.1).sum::<f64>();
    (0..rivals.len())
        .take_while(|i| before(i) < wanted - 1e-12)
        .count()
}

/// Runners-up with their probability against the named cause.
fn alternatives(
    bank: &Bank,
    posterior: &Posterior,
    set: &Scored,
    suspect: usize,
) -> Vec<(&'static str, String, f64)> {
    let mut rivals = posterior.stand_ins(set, suspect);
    rivals.retain(|r| bank.suspects[r.0].named);
    let told = rivals.iter().take(3).filter(|r| r.1 > 1e-3);
    told.map(|(s, odds)| {
        (
            bank.suspects[*s].effect,
            bank.suspects[*s].site.clone(),
            odds / (1.0 + odds),
        )
    })
    .collect()
}

/// The verdict.
pub fn verdict(named: &Named, rest: &Rest, judgement: &Judgement) -> Verdict {
    let nothing = named.causes.is_empty() && named.groups.is_empty();
    match (nothing, rest.is_left) {
        (true, true) => Verdict::UnknownCause,
        (true, false) => Verdict::Sufficient,
        (false, true) if rest.share > judgement.not_the_story => Verdict::UnknownCause,
        (false, true) => Verdict::PartlyExplained,
        (false, false) if named.causes.is_empty() => Verdict::CannotTell,
        (false, false) => Verdict::Explained,
    }
}
