//! An answer as it is printed (`formats.md`, section 3).

use super::answer::{Answer, Cause, Group, Verdict};
use super::gain::Gain;
use super::sentence::sentence;
use crate::fit::suitability::Doubt;
use serde::{Serialize, Serializer};
use std::borrow::Cow;

#[derive(Serialize)]
struct AnswerDocument<'a> {
    verdict: &'static str,
    sentence: String,
    discrepancy: DiscrepancyDocument<'a>,
    causes: Vec<CauseDocument<'a>>,
    cannot_separate: Vec<GroupDocument<'a>>,
    unexplained: UnexplainedDocument<'a>,
    candidates: Vec<CandidateDocument<'a>>,
    doubts: &'a [Doubt],
}

#[derive(Serialize)]
struct DiscrepancyDocument<'a> {
    rms: f64,
    noise_rms: f64,
    unit: &'static str,
    #[serde(rename = "where")]
    place: &'a str,
    noise: &'a str,
}

#[derive(Serialize)]
struct UnexplainedDocument<'a> {
    share_of_variance: f64,
    shape: &'a [[f64; 2]],
    shape_over_time: &'a [[f64; 2]],
    p_value: f64,
    description: &'a str,
}

#[derive(Serialize)]
struct CandidateDocument<'a> {
    effects: &'a [String],
    probability: f64,
    nats: f64,
}

#[derive(Serialize)]
struct AlternativeDocument<'a> {
    effect: &'static str,
    site: &'a str,
    probability: f64,
}

#[derive(Serialize)]
struct ParameterDocument<'a> {
    name: &'static str,
    site: &'a str,
    value: f64,
    unit: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    ci95: Option<[f64; 2]>,
}

/// A cause as it is printed.
#[derive(Serialize)]
pub struct CauseDocument<'a> {
    effect: &'static str,
    site: Cow<'a, str>,
    probability: f64,
    alternatives: Vec<AlternativeDocument<'a>>,
    parameters: Vec<ParameterDocument<'a>>,
    gain: &'a Gain,
}

impl<'a> CauseDocument<'a> {
    /// Of a cause that was named.
    pub fn of(cause: &'a Cause) -> Self {
        let alternatives = cause.alternatives.iter();
        let alternatives = alternatives.map(|(effect, site, probability)| AlternativeDocument {
            effect,
            site,
            probability: *probability,
        });
        let parameters = cause.parameters.iter();
        let parameters = parameters.map(|(name, value, unit)| ParameterDocument {
            name,
            site: &cause.site,
            value: *value,
            unit,
            ci95: cause.interval(name),
        });
        Self {
            effect: cause.effect,
            site: Cow::Borrowed(&cause.site),
            probability: cause.probability,
            alternatives: alternatives.collect(),
            parameters: parameters.collect(),
            gain: &cause.gain,
        }
    }

    /// Of a cause of which only the place is known.
    pub fn bare(effect: &'static str, site: String, probability: f64, gain: &'a Gain) -> Self {
        Self {
            effect,
            site: Cow::Owned(site),
            probability,
            alternatives: Vec::new(),
            parameters: Vec::new(),
            gain,
        }
    }

    /// What it gains.
    pub fn gain(&self) -> &Gain {
        self.gain
    }
}

/// Causes that cannot be told apart, as they are printed.
#[derive(Serialize)]
pub struct GroupDocument<'a> {
    effects: &'a [&'static str],
    sites: &'a [String],
    would_tell: &'a str,
    gain: &'a Gain,
}

impl<'a> GroupDocument<'a> {
    /// Of a group.
    pub fn of(group: &'a Group) -> Self {
        Self {
            effects: &group.effects,
            sites: &group.sites,
            would_tell: &group.would_tell,
            gain: &group.gain,
        }
    }
}

/// The causes; where they explain all, one member of each group stands among them, the first unless another does.
fn causes(answer: &Answer) -> Vec<CauseDocument<'_>> {
    let stands = |group: &&Group| {
        let members = || group.effects.iter().zip(&group.sites);
        let named = |cause: &Cause| members().any(|(e, s)| cause.effect == *e && cause.site == *s);
        answer.causes.iter().any(named)
    };
    let explained = answer.verdict == Verdict::Explained;
    // a question about one alone names nobody
    let open = |g: &&Group| explained && g.effects.len() > 1 && !stands(g);
    let groups = answer.groups.iter().filter(open);
    let first = |group: &'_ Group| Some((*group.effects.first()?, group.sites.first()?.clone()));
    let added = groups.filter_map(|group| {
        let (effect, site) = first(group)?;
        Some(CauseDocument::bare(
            effect,
            site,
            group.probability,
            &group.gain,
        ))
    });
    let mut all: Vec<CauseDocument> = answer.causes.iter().map(CauseDocument::of).collect();
    let named = all.len();
    all.extend(added);
    if all.len() > named {
        let gain = |c: &CauseDocument| Some(c.gain.reduction_percent).filter(|p| p.is_finite());
        all.sort_by(|a, b| gain(b).unwrap_or(0.0).total_cmp(&gain(a).unwrap_or(0.0)));
    }
    all
}

impl Serialize for Answer {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let candidates = self.candidates.iter();
        let candidates = candidates.map(|(effects, probability, nats)| CandidateDocument {
            effects,
            probability: *probability,
            nats: *nats,
        });
        let document = AnswerDocument {
            verdict: self.verdict.name(),
            sentence: sentence(self),
            discrepancy: DiscrepancyDocument {
                rms: self.discrepancy.rms,
                noise_rms: self.discrepancy.noise_rms,
                unit: self.unit,
                place: &self.discrepancy.place,
                noise: &self.noise,
            },
            causes: causes(self),
            cannot_separate: self.groups.iter().map(GroupDocument::of).collect(),
            unexplained: UnexplainedDocument {
                share_of_variance: self.unexplained.share_of_variance,
                shape: &self.unexplained.shape,
                shape_over_time: &self.unexplained.over_time,
                p_value: self.p_value,
                description: &self.unexplained.description,
            },
            candidates: candidates.collect(),
            doubts: &self.doubts,
        };
        document.serialize(serializer)
    }
}
