//! The answer as it is told.

use super::bank::Bank;
use super::choice::nothing;
use super::judgement::Judgement;
use super::posterior::Posterior;
use super::rest::Rest;
use super::search::Scored;
use super::statement::{Experiment, Statement};
use super::verdict::{Named, verdict};
use crate::findings::answer::{Answer, Candidate, Discrepancy, Structure, Verdict};
use crate::ground::stats::rms;

/// What is said of what is left where it does not count.
const NOTHING_LEFT: &str = "no more than the noise, and what laws miss anyway";

/// From what is named and what is left.
pub(super) fn answer(
    experiment: &dyn Experiment,
    statement: &Statement,
    bank: &Bank,
    (posterior, set): (&Posterior, &Scored),
    (named, rest): (Named, Rest),
    (missed, left): (&[f64], &[f64]),
    judgement: &Judgement,
) -> Answer {
    let noise = rms(statement.noise.spread()) * set.fit.posterior.noise_variance.sqrt();
    let before = rms(missed);
    let remaining = experiment.remaining(left);
    let verdict = verdict(&named, &rest, judgement);
    Answer {
        verdict,
        discrepancy: Discrepancy {
            rms: before,
            noise_rms: noise,
            place: experiment.place(missed),
        },
        causes: named.causes,
        groups: named.groups,
        unexplained: Structure {
            share_of_variance: share_left(left, (noise, missed)),
            shape: remaining.shape,
            over_time: remaining.over_time,
            description: match verdict {
                Verdict::UnknownCause | Verdict::PartlyExplained => remaining.description,
                _ => NOTHING_LEFT.into(),
            },
        },
        p_value: (-rest.nats).exp(),
        candidates: posterior
            .sets
            .iter()
            .take(10)
            .map(|s| candidate(bank, &s.0, s.1, posterior))
            .collect(),
        unit: experiment.unit(),
        noise: statement.noise.describe(),
        unstated: false,
        doubts: Vec::new(),
    }
}

/// Share of what is missed that is left beyond the noise (rms), of its variance.
pub(super) fn share_left(left: &[f64], (noise, missed): (f64, &[f64])) -> f64 {
    let all = rms(missed).powi(2).max(f64::MIN_POSITIVE);
    ((rms(left).powi(2) - noise * noise) / all).clamp(0.0, 1.0)
}

fn candidate(bank: &Bank, set: &Scored, p: f64, posterior: &Posterior) -> Candidate {
    let own = set.suspects.iter().map(|s| &bank.suspects[*s]);
    let names = own.map(|s| format!("{} {}", s.effect, s.site)).collect();
    let empty = nothing(posterior).fit.posterior.ln_evidence;
    (names, p, set.fit.posterior.ln_evidence - empty)
}

/// What is seen where only its scatter is too large.
pub(super) fn scattering(times: f64) -> String {
    format!(
        "a scatter of {times:.1} times the noise that is stated, or seen between neighbours, and no pattern in it: the noise \
         is larger, or what scatters is none"
    )
}
