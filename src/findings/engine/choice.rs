//! Which set of causes is named: what matters, is needed, is real on unseen data, and beats structure of any
//! kind.

use super::bank::Bank;
use super::judgement::Judgement;
use super::materiality::{Materiality, amounts};
use super::posterior::{Posterior, without};
use super::rest::Span;
use super::search::{Scored, price};
use super::statement::Statement;
use super::unseen::gains;
use crate::findings::gain::Gain;
use nalgebra::DVector;

/// Sets below the best that matters by more than this are not tried, nats.
pub(super) const HOPELESS: f64 = 60.0;

/// Sets whose every cause matters; the empty one always does. What is hopeless is measured by the best set
/// that matters: one with a further cause too small to be named may lead by what laws miss of large ones.
pub(super) fn material(
    statement: &Statement,
    bank: &Bank,
    sets: Vec<Scored>,
    judgement: &Judgement,
) -> Vec<Scored> {
    // with patterns beside the causes, and without: the best set of causes alone is what a kind is stated about
    let mut best = [f64::NEG_INFINITY; 2];
    let mut materiality = Materiality::new(statement, bank, judgement);
    let mut holds = |s: &Scored| {
        let own = usize::from(s.suspects.iter().all(|s| bank.suspects[*s].named));
        let matters = s.score > best[own] - HOPELESS && materiality.holds(&s.fit);
        if matters {
            best[own] = best[own].max(s.score);
        }
        matters || s.suspects.is_empty()
    };
    sets.into_iter().filter(|s| holds(s)).collect()
}

/// A set less what cannot be of its amounts: it stands for something that is uncertain anyway, and nobody is blamed for it.
pub(super) fn possible(
    bank: &Bank,
    posterior: &Posterior,
    mut set: Scored,
    judgement: &Judgement,
) -> Scored {
    while let Some(at) = impossible(bank, &set) {
        set = less(bank, posterior, &set, at, judgement);
    }
    set
}

/// The first of a set that cannot be of its amounts.
fn impossible(bank: &Bank, set: &Scored) -> Option<usize> {
    let amounts = amounts(bank, &set.fit);
    let can_be = |(member, amounts): (&usize, &DVector<f64>)| {
        (bank.suspect(*member).can_be)(&bank.member(*member).shape, amounts.as_slice())
    };
    let mut each = set.fit.members.iter().zip(&amounts);
    each.position(|own| !can_be(own))
}

pub(super) fn nothing(posterior: &Posterior) -> Scored {
    let empty = posterior.set(&[]).or(posterior.sets.first().map(|s| &s.0));
    empty
        .cloned()
        .unwrap_or_else(|| unreachable!("the empty set is always compared"))
}

/// The best set, less companions that are not probable enough; nothing, where the set and all that can take the place of one of its causes are no
/// more probable than a kind asks (`Judgement::over_none`). Sets that become smaller later are not asked again.
pub(super) fn choose(posterior: &Posterior, judgement: &Judgement) -> Scored {
    let mut set = posterior
        .sets
        .first()
        .map_or_else(|| nothing(posterior), |s| s.0.clone());
    while set.suspects.len() > 1 {
        // what a stand-in takes is not lost: some companion is there
        let probability = |s: &usize| posterior.inclusion_of_place(&set, *s);
        let weakest = set
            .suspects
            .iter()
            .min_by(|a, b| probability(a).total_cmp(&probability(b)));
        let Some(weakest) = weakest
            .copied()
            .filter(|s| probability(s) < judgement.companion_needed)
        else {
            break;
        };
        let Some(less) = posterior.set(&without(&set.suspects, weakest)) else {
            break;
        };
        set = less.clone();
    }
    let none = nothing(posterior);
    let stand_ins = set
        .suspects
        .iter()
        .flat_map(|s| posterior.stand_ins(&set, *s));
    let own = 1.0
        + stand_ins
            .filter(|s| !set.suspects.contains(&s.0))
            .map(|s| s.1)
            .sum::<f64>();
    match own * posterior.odds(&set, &none) < judgement.over_none {
        true => none,
        false => set,
    }
}

/// Most causes of a set that is named because it leaves only scatter.
const PLAIN: usize = 2;

/// The smallest set, the best of its size, of which `is_scatter` says that it leaves nothing more.
pub(super) fn plain(posterior: &Posterior, is_scatter: impl Fn(&Scored) -> bool) -> Option<Scored> {
    let of_size = |size: usize| {
        let mut own = posterior
            .sets
            .iter()
            .map(|s| &s.0)
            .filter(move |s| s.suspects.len() == size);
        own.next()
    };
    let found = (1..=PLAIN).filter_map(of_size).find(|s| is_scatter(s));
    found.cloned()
}

/// The set less causes that gain nothing on unseen rows, and the gains of all others.
pub(super) fn drop_unreal(
    statement: &Statement,
    bank: &Bank,
    posterior: &Posterior,
    mut set: Scored,
    judgement: &Judgement,
) -> (Scored, Vec<Gain>) {
    loop {
        let gains = gains(statement, bank, &set.fit, judgement.companion_gain);
        let least = match gains.len() {
            1 => 0.0,
            _ => judgement.companion_gain,
        };
        let law = missed_by_law(bank, &set, &gains, judgement);
        let unreal = gains.iter().enumerate().filter(|(_, g)| {
            let is_small = g.reduction_percent < least || g.explained() < law;
            !g.is_real() || is_small || judgement.is_negligible(g)
        });
        let worst = unreal.min_by(|a, b| a.1.reduction_percent.total_cmp(&b.1.reduction_percent));
        let Some((at, _)) = worst else {
            return (set, gains);
        };
        set = less(bank, posterior, &set, at, judgement);
    }
}

/// Squares of unseen readings that may be what the law of the largest cause misses that adds no straight line; -∞ where nobody asks.
pub(super) fn missed_by_law(
    bank: &Bank,
    set: &Scored,
    gains: &[Gain],
    judgement: &Judgement,
) -> f64 {
    let bends = |m: &usize| bank.suspect(*m).named && bank.member(*m).within.is_some();
    let own = set.fit.members.iter().zip(gains);
    let own = own.filter(|(m, _)| bends(m)).map(|(_, g)| g.explained());
    let largest = own.fold(f64::NEG_INFINITY, f64::max);
    match judgement.companion_share > 0.0 && set.suspects.len() > 1 {
        true => judgement.companion_share.powi(2) * largest,
        false => f64::NEG_INFINITY,
    }
}

/// A set less one of its causes: as it was weighed, or fitted now.
pub(super) fn less(
    bank: &Bank,
    posterior: &Posterior,
    set: &Scored,
    at: usize,
    judgement: &Judgement,
) -> Scored {
    let mut members = set.fit.members.clone();
    members.remove(at);
    let suspects = members
        .iter()
        .map(|m| bank.entries[*m].suspect)
        .collect::<Vec<_>>();
    match (posterior.set(&suspects), bank.fit(&members)) {
        (Some(less), _) => less.clone(),
        (None, Some(fit)) => Scored::of(bank, fit, &nothing(posterior).fit, judgement),
        (None, None) => nothing(posterior),
    }
}

/// Several causes must be worth their price beside structure of any kind: else that is the better story.
pub(super) fn loses_to_structure(
    bank: &Bank,
    posterior: &Posterior,
    set: &Scored,
    span: Option<&Span>,
    judgement: &Judgement,
) -> bool {
    let Some(span) = span.filter(|_| set.suspects.len() > 1) else {
        return false;
    };
    let empty = nothing(posterior).fit;
    let price = price(bank, &set.fit.members, judgement);
    let with = span.best(bank, &set.fit) - set.fit.beyond;
    with - price < span.best(bank, &empty) - empty.beyond
}
