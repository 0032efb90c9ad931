//! From a chosen set to causes, groups and the verdict.

use super::bank::Bank;
use super::intervals::intervals;
use super::judgement::Judgement;
use super::posterior::Posterior;
use super::rest::Rest;
use super::rivals::{Rivals, runners_up};
use super::search::Scored;
use super::statement::{Blamed, Experiment, Suspect};
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

impl Named {
    /// Adds what cannot be told apart: effects with their sites, the named one first with its probability.
    pub fn group(
        &mut self,
        (members, probability): (Vec<(&'static str, String)>, f64),
        would_tell: String,
        gain: Gain,
    ) {
        self.groups.push(Group {
            probability,
            would_tell,
            effects: members.iter().map(|m| m.0).collect(),
            sites: members.into_iter().map(|m| m.1).collect(),
            gain,
        });
    }

    /// The causes that gain most first.
    pub fn sorted(mut self) -> Self {
        let by_gain = |a: &Cause, b: &Cause| {
            let gains = [b, a].map(|cause| cause.gain.reduction_percent);
            gains[0].total_cmp(&gains[1])
        };
        self.causes.sort_by(by_gain);
        self
    }

    /// Whether a cause surely makes a good part of the error.
    fn carries(&self, judgement: &Judgement) -> bool {
        let surely = |c: &Cause| c.gain.ci95_percent[0] > judgement.of_the_story_percent;
        self.causes.iter().any(surely)
    }
}

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
    let is_named = |s: usize| bank.suspects[s].named;
    let place = |s: usize| (bank.suspects[s].effect, bank.suspects[s].site.clone());
    for (at, suspect) in set.suspects.iter().enumerate() {
        if !is_named(*suspect) {
            continue;
        }
        let is_other = |s: usize| !are_nested(&bank.suspects[s], &bank.suspects[*suspect]);
        let may_be = |s: usize| is_named(s) && is_other(s);
        let rivals = Rivals::of(posterior, set, *suspect, may_be, judgement);
        if !rivals.open.is_empty() {
            let probability = rivals.probability(posterior, judgement);
            let members = std::iter::once(*suspect).chain(rivals.open);
            let members: Vec<(&'static str, String)> = members.map(place).collect();
            let would_tell = experiment.would_tell(&members);
            named.group((members, probability), would_tell, gains[at]);
            continue;
        }
        let own = &bank.suspects[*suspect];
        let runners_up = runners_up(posterior, set, *suspect, is_named).into_iter();
        let told =
            runners_up.map(|(s, p)| (bank.suspects[s].effect, bank.suspects[s].site.clone(), p));
        named.causes.push(Cause {
            effect: own.effect,
            site: own.site.clone(),
            probability: rivals.probability(posterior, judgement),
            summary: own.summary,
            alternatives: told.collect(),
            ci95: match experiment.has_sure_intervals(own.effect) {
                true => intervals(experiment, bank, posterior, (set, at), judgement),
                false => Vec::new(),
            },
            parameters: experiment.parameters(&blamed[at]),
            gain: gains[at],
        });
    }
    named.sorted()
}

/// Whether the place of one is a part of that of the other and both are the same effect, as of a sensor and one of its axes: the cause is then the
/// same, and where it sits is told by the more probable of the two.
fn are_nested(one: &Suspect, other: &Suspect) -> bool {
    let is_part = |part: &str, whole: &str| {
        let rest = part.strip_prefix(whole);
        rest.is_some_and(|rest| rest.starts_with('-'))
    };
    let sites = (&one.site, &other.site);
    one.effect == other.effect && (is_part(sites.0, sites.1) || is_part(sites.1, sites.0))
}

/// The verdict.
pub fn verdict(named: &Named, rest: &Rest, judgement: &Judgement) -> Verdict {
    let nothing = named.causes.is_empty() && named.groups.is_empty();
    match (nothing, rest.is_left) {
        (true, true) => Verdict::UnknownCause,
        (true, false) => Verdict::Sufficient,
        (false, true) if rest.share > judgement.not_the_story && !named.carries(judgement) => {
            Verdict::UnknownCause
        }
        (false, true) => Verdict::PartlyExplained,
        (false, false) if named.causes.is_empty() => Verdict::CannotTell,
        (false, false) => Verdict::Explained,
    }
}
