//! The whole way: from a kind's statement to its answer.

use super::bank::{Bank, Fit};
use super::choice::{choose, drop_unreal, loses_to_structure, material, nothing, plain, possible};
use super::judgement::Judgement;
use super::leaves::{Leaves, Weighing};
use super::materiality::raw_parts;
use super::posterior::Posterior;
use super::rest::{Span, explained};
use super::search::{Scored, search};
use super::statement::{Blamed, Experiment, Statement};
use super::told::{answer, scattering};
use super::verdict::name;
use super::{carried, rounds, unseen};
use crate::findings::answer::{Answer, Verdict};
use crate::findings::gain::Gain;
use crate::ground::stats::rms;

/// A finished diagnosis.
#[derive(Debug, Clone)]
pub struct Found {
    /// The answer.
    pub answer: Answer,
    /// The chosen causes with their amounts.
    pub blamed: Vec<Blamed>,
    /// What the present simulation misses, with the nuisances at their most probable: per row.
    pub missed: Vec<f64>,
    /// What the named causes make of it, per row.
    pub explained: Vec<f64>,
    /// What they leave, per row.
    pub left: Vec<f64>,
    /// Most probable amounts of the nuisances beside the causes.
    pub(super) uncertain: Vec<f64>,
    /// The best set of causes whether or not they are named: what a kind that is not linear is stated about.
    pub(super) lead: Vec<Blamed>,
    /// Evidence of every set that was compared, over that of no cause, no prior in it: (effect and site of
    /// each cause, ln E).
    pub evidence: Vec<(Vec<(&'static str, String)>, f64)>,
}

/// Diagnoses.
pub fn diagnose(experiment: &dyn Experiment, judgement: &Judgement) -> Found {
    let first = stated(experiment, &[], &[]);
    let found = about(experiment, (&first, &first.reading), judgement);
    match experiment.is_linear() || found.lead.is_empty() {
        true => found,
        false => rounds::settled(experiment, (first, found), judgement),
    }
}

/// The statement without suspects that change nothing here: they have no column to be compared by.
pub(super) fn stated(
    experiment: &dyn Experiment,
    blamed: &[Blamed],
    uncertain: &[f64],
) -> Statement {
    let mut statement = experiment.state_beside(blamed, uncertain);
    for suspect in &mut statement.suspects {
        suspect.members.retain(|m| !m.columns.is_empty());
    }
    statement.suspects.retain(|s| !s.members.is_empty());
    statement
}

/// The answer of one statement; `present`: the reading of the first one, about nothing.
pub(super) fn about(
    experiment: &dyn Experiment,
    (statement, present): (&Statement, &[f64]),
    judgement: &Judgement,
) -> Found {
    let mut bank = Bank::new(statement);
    let compared = search(&mut bank, judgement);
    let named = |s: &&Scored| s.suspects.iter().all(|s| bank.suspects[*s].named);
    let evidence = compared
        .iter()
        .filter(named)
        .map(|s| evidence_of(&bank, s, judgement))
        .collect();
    let story = compared.first().cloned();
    let sets = material(statement, &bank, compared, judgement);
    let rough = experiment.has_rough_laws();
    let nats = sets.first().filter(|_| rough).map(|s| worth(&bank, &s.fit));
    let mut posterior = Posterior::of(sets, judgement.exponent(nats));
    let span = Span::of(statement);
    let nothing = nothing(&posterior).fit;
    let weighing = Weighing::new(statement, &bank, span.as_ref(), &nothing, judgement);
    let picked = picked(experiment, &weighing, &mut posterior, story.as_ref());
    let Picked { set, leaves, gains } = picked;
    // where laws are only nearly right the spring itself is fitted, not stated: its gains are those that decided
    let gains = match rough {
        true => gains,
        false => carried::told(statement, present, &bank, &set.fit),
    };
    let Leaves {
        left,
        mut uncertain,
        seen,
        rest,
    } = leaves;
    let mut blamed = blamed(&bank, &set.fit);
    let named = name(
        experiment,
        &bank,
        &posterior,
        &set,
        (&blamed, &gains),
        judgement,
    );
    let mut answer = answer(
        experiment,
        statement,
        &bank,
        (&posterior, &set),
        (named, rest),
        (&weighing.missed, &left),
        judgement,
    );
    if let Some(seen) = seen.map(Into::into).or(rest.scatter.map(scattering)) {
        answer.unexplained.description = seen;
    }
    let mut own = set.suspects.iter().map(|s| bank.suspects[*s].named);
    blamed.retain(|_| own.next().unwrap_or(true));
    let competed = bank.suspects.iter().any(|s| !s.named);
    let open = competed && answer.verdict != Verdict::Sufficient;
    let lead = match (blamed.is_empty(), leading(&bank, &posterior)) {
        (true, Some(fit)) if open => {
            uncertain = weighing.beside(&fit).1;
            self::blamed(&bank, &fit)
        }
        _ => blamed.clone(),
    };
    let missed = weighing.missed;
    let explained = missed.iter().zip(&left).map(|(m, l)| m - l).collect();
    Found {
        answer,
        blamed,
        missed,
        explained,
        left,
        uncertain,
        lead,
        evidence,
    }
}

/// The best set of causes of the library.
fn leading(bank: &Bank, posterior: &Posterior) -> Option<Fit> {
    let named = |s: &&(Scored, f64)| s.0.suspects.iter().all(|s| bank.suspects[*s].named);
    posterior.sets.iter().find(named).map(|s| s.0.fit.clone())
}

/// The set that is named, with what its causes gain and what it leaves.
struct Picked {
    set: Scored,
    gains: Vec<Gain>,
    leaves: Leaves,
}

/// What is probable, real on unseen rows, and beats structure of any kind.
fn picked(
    experiment: &dyn Experiment,
    weighing: &Weighing,
    posterior: &mut Posterior,
    story: Option<&Scored>,
) -> Picked {
    let (statement, bank, judgement) = (weighing.statement, weighing.bank, weighing.judgement);
    let real = |posterior: &Posterior, set: &Scored| {
        drop_unreal(statement, bank, posterior, set.clone(), judgement)
    };
    let mut chosen = possible(bank, posterior, choose(posterior, judgement));
    let (mut set, mut gains) = real(posterior, &chosen);
    if loses_to_structure(bank, posterior, &set, weighing.span, judgement) {
        let is_scatter = |set: &Scored| experiment.is_scatter(&weighing.beside(&set.fit).0);
        chosen = plain(posterior, is_scatter)
            .map(|set| possible(bank, posterior, set))
            .unwrap_or_else(|| nothing(posterior));
        posterior.keep_up_to(chosen.suspects.len());
        (set, gains) = real(posterior, &chosen);
    }
    let leaves = weighing.leaves(&set, story);
    let kept = Picked { set, gains, leaves };
    if experiment.has_rough_laws() {
        return match kept.leaves.rest.is_left {
            true => needed(weighing, posterior, &chosen, &kept).unwrap_or(kept),
            false => kept,
        };
    }
    let kept = outweighed(weighing, posterior, kept);
    needed(weighing, posterior, &chosen, &kept).unwrap_or(kept)
}

/// Without companions that explain less of the unseen readings than is left of them beyond the noise, where something is: it may
/// be they that stand for it. Where deviations are only relative to one another, what is beyond the noise is not known.
fn outweighed(weighing: &Weighing, posterior: &Posterior, mut kept: Picked) -> Picked {
    let noise = &weighing.statement.noise;
    if noise.rows() == 0.0 {
        return kept;
    }
    let noise = rms(noise.spread());
    while kept.leaves.rest.is_left && kept.set.suspects.len() > 1 {
        let each = kept.gains.iter().enumerate();
        let least = each.min_by(|a, b| a.1.explained().total_cmp(&b.1.explained()));
        let Some((at, gain)) = least else { break };
        if gain.explained() >= gain.after.powi(2) - noise * noise {
            break;
        }
        let mut suspects = kept.set.suspects.clone();
        suspects.remove(at);
        let Some(set) = posterior.set(&suspects).cloned() else {
            break;
        };
        let gains = unseen::gains(weighing.statement, weighing.bank, &set.fit);
        let leaves = weighing.leaves(&set, None);
        kept = Picked { set, gains, leaves };
    }
    kept
}

/// The set as it was chosen, where nothing is left beside it, and all that was dropped is probable and neither lowers nor
/// raises the error of unseen rows: all that is uncertain may stand in for it there, far from where it is known to be.
/// Where laws are only nearly right, a probable cause may be what they miss, and something must be left without it.
fn needed(
    weighing: &Weighing,
    posterior: &Posterior,
    chosen: &Scored,
    kept: &Picked,
) -> Option<Picked> {
    let (bank, judgement) = (weighing.bank, weighing.judgement);
    // where nobody states the noise, a companion that unseen rows do not show is worth the noise that it makes smaller
    let is_told = weighing.statement.noise.rows() > 0.0;
    if !is_told && !kept.set.suspects.is_empty() && !kept.leaves.rest.is_left {
        return None;
    }
    let is_dropped = |s: &usize| !kept.set.suspects.contains(s);
    // one cause, or one that can take its place; of several, each for itself
    let probability = |s: usize| match chosen.suspects.len() {
        1 => posterior.inclusion_of_place(chosen, s),
        _ => posterior.inclusion(s),
    };
    let is_probable = |s: &usize| probability(*s) >= judgement.companion_needed;
    let own = chosen.suspects.iter().copied();
    let probable: Vec<usize> = own.filter(|s| !is_dropped(s) || is_probable(s)).collect();
    let chosen = posterior.set(&probable)?.clone();
    let gains = unseen::gains(weighing.statement, bank, &chosen.fit);
    let changes_nothing =
        |gain: &Gain| !gain.is_real() && gain.reduction_percent > -judgement.companion_gain;
    let mut each = chosen.suspects.iter().zip(&gains);
    let all = each
        .all(|(s, gain)| !is_dropped(s) || changes_nothing(gain) && !judgement.is_negligible(gain));
    if !all || !chosen.suspects.iter().any(is_dropped) {
        return None;
    }
    if loses_to_structure(bank, posterior, &chosen, weighing.span, judgement) {
        return None;
    }
    let leaves = weighing.leaves(&chosen, None);
    (!leaves.rest.is_left).then_some(Picked {
        set: chosen,
        gains,
        leaves,
    })
}

/// Nats that all a set explains is worth beside the noise that it leaves.
fn worth(bank: &Bank, fit: &Fit) -> f64 {
    let rows = bank.whitened().len() as f64;
    0.5 * rows * explained(bank, fit).powi(2) / fit.posterior.noise_variance
}

fn evidence_of(
    bank: &Bank,
    set: &Scored,
    judgement: &Judgement,
) -> (Vec<(&'static str, String)>, f64) {
    let own = set.suspects.iter().map(|s| &bank.suspects[*s]);
    let places = own.map(|s| (s.effect, s.site.clone())).collect();
    // the shapes' and the amounts' prices belong to the evidence; the odds of names do not
    let names = set.suspects.len() as f64;
    let shares: f64 = set.suspects.iter().map(|s| bank.suspects[*s].share).sum();
    let odds = judgement.name * names + judgement.companion * (names - 1.0).max(0.0) - shares;
    (places, set.score + odds)
}

fn blamed(bank: &Bank, fit: &Fit) -> Vec<Blamed> {
    let mut at = 0;
    let variance = fit.posterior.noise_variance;
    let each = fit
        .members
        .iter()
        .zip(raw_parts(bank, fit))
        .map(|(member, part)| {
            let (entry, suspect, own) = (
                &bank.entries[*member],
                bank.suspect(*member),
                bank.member(*member),
            );
            let (first, count) = (at, own.columns.len());
            at += count;
            let covariance = fit
                .posterior
                .covariance
                .view((first, first), (count, count));
            Blamed {
                effect: suspect.effect,
                site: suspect.site.clone(),
                shape: own.shape.clone(),
                amounts: (0..count)
                    .map(|k| fit.posterior.mean[first + k] * entry.scale)
                    .collect(),
                covariance: covariance * (variance * entry.scale * entry.scale),
                part,
            }
        });
    each.collect()
}
