//! The set that is named: probable, real on unseen rows, and better than structure of any kind.

use super::choice::{choose, drop_unreal, loses_to_structure, nothing, plain, possible};
use super::leaves::{Leaves, Weighing};
use super::posterior::Posterior;
use super::search::Scored;
use super::statement::Experiment;
use super::unseen;
use crate::findings::gain::Gain;
use crate::ground::stats::rms;

/// The set that is named, with what its causes gain and what it leaves.
pub(super) struct Picked {
    pub set: Scored,
    pub gains: Vec<Gain>,
    pub leaves: Leaves,
}

/// What is probable, real on unseen rows, and beats structure of any kind.
pub(super) fn picked(
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
