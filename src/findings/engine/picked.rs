//! The set of causes that is named: what is probable, real on unseen rows, beats structure of any kind, and is not outweighed by
//! what it leaves.

use super::choice::{
    choose, drop_unreal, less, loses_to_structure, missed_by_law, nothing, plain, possible,
};
use super::leaves::{Leaves, Weighing};
use super::materiality::{in_noise, raw_parts};
use super::posterior::Posterior;
use super::search::Scored;
use super::statement::Experiment;
use super::{carried, unseen};
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
    let mut chosen = possible(bank, posterior, choose(posterior, judgement), judgement);
    let (mut set, mut gains) = real(posterior, &chosen);
    if loses_to_structure(bank, posterior, &set, weighing.span, judgement) {
        let is_scatter = |set: &Scored| experiment.is_scatter(&weighing.beside(&set.fit).0);
        chosen = plain(posterior, is_scatter)
            .map(|set| possible(bank, posterior, set, judgement))
            .unwrap_or_else(|| nothing(posterior));
        posterior.keep_up_to(chosen.suspects.len());
        (set, gains) = real(posterior, &chosen);
    }
    let leaves = weighing.leaves(&set, story);
    let kept = Picked { set, gains, leaves };
    if experiment.has_rough_laws() {
        return match kept.leaves.rest.is_left {
            true => needed(
                weighing,
                posterior,
                &chosen,
                &kept,
                judgement.not_plain_gain,
            )
            .unwrap_or(kept),
            false => kept,
        };
    }
    let kept = outweighed(weighing, posterior, kept);
    needed(
        weighing,
        posterior,
        &chosen,
        &kept,
        -judgement.companion_gain,
    )
    .unwrap_or(kept)
}

/// With the gains as they are told, and without companions that surely make the simulation worse as it is used: they fit only where
/// all that is uncertain moves against them, and stand for what it cannot do. The last cause stands where unseen rows plainly tell that
/// something is wrong: what is uncertain may hide it. Where structure is left that nobody makes, any cause may stand for it: one whose
/// gain is not plain takes no name, nor any companion where a kind asks that (`Judgement::companion_is_plain`). Nor do several, none of
/// which plainly gains: together they fit what none of them makes.
pub(super) fn carrying(
    weighing: &Weighing,
    posterior: &Posterior,
    present: &[f64],
    kept: Picked,
) -> Picked {
    let (statement, bank, judgement) = (weighing.statement, weighing.bank, weighing.judgement);
    let Picked {
        mut set,
        mut leaves,
        ..
    } = kept;
    loop {
        let gains = carried::told(statement, present, (bank, &set.fit), judgement);
        let is_named = |at: &usize| bank.suspects[set.suspects[*at]].named;
        let surely_worse = |at: &usize| gains[*at].ci95_percent[1] < 0.0;
        let gained = |at: &usize| gains[*at].reduction_percent;
        let named = (0..gains.len()).filter(is_named);
        let is_last = named.clone().count() == 1;
        let must_be_plain = leaves.rest.is_left || judgement.companion_is_plain && !is_last;
        let stands_in = |at: &usize| must_be_plain && gains[*at].ci95_percent[0] <= 0.0;
        let plainly = judgement.companion_gain;
        let decided =
            |at: usize| unseen::gains(statement, bank, &set.fit, plainly)[at].reduction_percent;
        let stands = |at: &usize| is_last && decided(*at) >= judgement.companion_gain;
        let none_gains = !is_last && named.clone().all(|at| gains[at].ci95_percent[0] <= 0.0);
        let worse =
            named.filter(|at| none_gains || stands_in(at) || surely_worse(at) && !stands(at));
        let Some(at) = worse.min_by(|a, b| gained(a).total_cmp(&gained(b))) else {
            return Picked { set, gains, leaves };
        };
        set = less(bank, posterior, &set, at, judgement);
        leaves = weighing.leaves(&set, None);
    }
}

/// Without causes that explain less of the unseen readings than is left of them beyond the noise, where something is: it may
/// be they that stand for it. The last one stands unless what is left is the story. Where deviations are only relative to one
/// another, what is beyond the noise is not known.
fn outweighed(weighing: &Weighing, posterior: &Posterior, mut kept: Picked) -> Picked {
    let (bank, judgement) = (weighing.bank, weighing.judgement);
    if weighing.statement.noise.rows() == 0.0 {
        return kept;
    }
    let is_named = |kept: &Picked, at: usize| bank.suspects[kept.set.suspects[at]].named;
    while kept.leaves.rest.is_left {
        let named = (0..kept.set.suspects.len()).filter(|at| is_named(&kept, *at));
        let named: Vec<usize> = named.collect();
        let is_last = named.len() == 1 && kept.leaves.rest.share <= judgement.not_the_story;
        let explained = |at: &usize| kept.gains[*at].explained();
        let least = named
            .into_iter()
            .min_by(|a, b| explained(a).total_cmp(&explained(b)));
        let Some(at) = least.filter(|_| !is_last) else {
            break;
        };
        if explained(&at) >= beyond(weighing, &kept, at) {
            break;
        }
        let set = less(bank, posterior, &kept.set, at, judgement);
        let gains = unseen::gains(weighing.statement, bank, &set.fit, judgement.companion_gain);
        let leaves = weighing.leaves(&set, None);
        kept = Picked { set, gains, leaves };
    }
    kept
}

/// Mean square of what no cause explains beyond the noise: of unseen readings beside a cause, and of all where a pattern takes
/// what nobody explains.
fn beyond(weighing: &Weighing, kept: &Picked, at: usize) -> f64 {
    let noise = &weighing.statement.noise;
    let left = match kept.leaves.seen {
        Some(_) => {
            let left = in_noise(weighing.statement, &kept.leaves.left);
            let each = left.iter().zip(noise.weights());
            rms(&each.map(|(l, w)| l * w).collect::<Vec<_>>())
        }
        None => 0.0,
    };
    kept.gains[at].after.max(left).powi(2) - rms(noise.spread()).powi(2)
}

/// The set as it was chosen, where nothing is left beside it, and all that was dropped is probable and does not raise the error
/// of unseen rows (where laws are only nearly right: halves it, or plainly lowers it). It may be plain beside all others alone; or lower the error by little, but by more than laws miss of the
/// largest; or not at all, since all that is uncertain may stand in for it there, far from where it is known to be. Where that
/// alone costs more than the price of a cause, unseen rows may show a little of it as well, and something may be left.
/// Where laws are only nearly right, a probable cause may be what they miss, and something must be left without it. `least`: by how many
/// percent one must lower that error where its interval is not plain.
fn needed(
    weighing: &Weighing,
    posterior: &Posterior,
    chosen: &Scored,
    kept: &Picked,
    least: f64,
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
    let gains = unseen::gains(
        weighing.statement,
        bank,
        &chosen.fit,
        judgement.companion_gain,
    );
    let leaves = weighing.leaves(&chosen, None);
    let is_strained = kept.leaves.strain > leaves.strain + judgement.further();
    let largest = gains.iter().map(Gain::explained).fold(0.0, f64::max);
    let missed = judgement.formula_error.powi(2) * largest;
    let law = missed_by_law(bank, &chosen, &gains, judgement);
    let may_stand = |gain: &Gain| {
        // beside all others it may be plain what is not plain without them; little is what laws miss of the largest, too
        let is_little = gain.reduction_percent < judgement.companion_gain;
        let is_missed =
            gain.is_real() && is_little && gain.explained() < missed || gain.explained() < law;
        let is_shown = gain.is_real() || gain.reduction_percent > least;
        (is_strained || !is_missed) && is_shown
    };
    // what spares strain is as large as what it does, however little unseen rows show of that
    let parts = raw_parts(bank, &chosen.fit);
    let is_negligible = |at: usize| match is_strained {
        true => rms(&parts[at]) < judgement.negligible,
        false => judgement.is_negligible(&gains[at]),
    };
    let falls = |at: &usize| {
        let stands = may_stand(&gains[*at]) && !is_negligible(*at);
        is_dropped(&chosen.suspects[*at]) && !stands
    };
    let gained = |at: &usize| gains[*at].reduction_percent;
    let fallen = (0..gains.len()).filter(falls);
    if let Some(at) = fallen.min_by(|a, b| gained(a).total_cmp(&gained(b))) {
        // the others may be needed without it
        let others = less(bank, posterior, &chosen, at, judgement);
        return needed(weighing, posterior, &others, kept, least);
    }
    if !chosen.suspects.iter().any(is_dropped) {
        return None;
    }
    if loses_to_structure(bank, posterior, &chosen, weighing.span, judgement) {
        return None;
    }
    // what is plain here was not where it was dropped: then nothing may be left
    let is_plain =
        |gain: &Gain| gain.is_real() && gain.reduction_percent >= judgement.companion_gain;
    let mut each = chosen.suspects.iter().zip(&gains);
    let was_plain = each.any(|(s, gain)| is_dropped(s) && is_plain(gain));
    let is_better = is_strained && kept.leaves.rest.is_left && !was_plain;
    (!leaves.rest.is_left || is_better).then_some(Picked {
        set: chosen,
        gains,
        leaves,
    })
}
