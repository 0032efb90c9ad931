//! A joint that bends by other laws than those asked for. A gap and slips of springs in parallel are what a joint mostly
//! has; the curve may as well stiffen without a gap, or slip without an end, and the numbers of the wrong law would be
//! wrong.

use super::comparison::{BEYOND, ahead, misses};
use super::observation::Observation;
use super::parameter::Status;
use super::solution::{Solution, fit_from, fit_until};
use super::time_course::guess;
use crate::effects::composite::Slot;
use crate::effects::{Composite, Effect, named};
use crate::inference::descent::Stop;

/// The cause whose size must not be that of another law.
pub const GAP: &str = "backlash";
/// What may change: the cause whose law goes, if one goes, and the law that comes. Beside another curve none comes: the two
/// would share the spring out between them.
const CHANGES: [(Option<&str>, &str); 5] = [
    (Some(GAP), "cubic_stiffness"),
    (Some(GAP), "soft_zone"),
    (Some(GAP), "hertz_contact"),
    (Some("hysteresis"), "bouc_wen"),
    (None, "cubic_stiffness"),
];
/// Most changes, one after the other.
const MOST: usize = 2;
/// What a law leaves about the parameters of the one before, in sums of squares of what that left, above which no descent is
/// tried: it would have to gain two nats a row.
const HOPELESS: f64 = 50.0;
/// Rows with which laws are compared at first.
const QUICK: usize = 400;
/// Where a descent ends that only compares: this share of the sum of so many rows' squares is a fiftieth of a nat.
const COMPARED: Stop = Stop::at_share(20, 1e-4);

/// What became of the gap of a model.
pub struct Gap {
    /// The cause whose law does as well, or better; `None` where the gap is told, or none is there.
    pub rival: Option<&'static str>,
    /// Largest gap that the law of a gap allows (95 %): it holds where another law explains what the gap did.
    pub limit: Option<f64>,
}

/// Puts laws in the place of those of a fit where the readings demand it, and takes a gap back that is not told from a law
/// without one. Only a model with a gap is changed (`None`: it has none): who asks for other laws gets them.
pub fn weigh_gap(solution: &mut Solution, data: &Observation) -> Option<Gap> {
    let own = solution.amplitude_of(GAP)?;
    let limit = Some(solution.limit(own)).filter(|limit| limit.is_finite() && *limit > 0.0);
    if misses(solution)
        && let Some(other) = other_law(solution, data)
    {
        *solution = other;
    }
    let rival = gap_or(solution, data).or_else(|| in_its_place(&solution.model));
    Some(Gap { rival, limit })
}

/// The fit by the laws that the readings demand in the place of those of `asked`, if any are worth it.
fn other_law(asked: &Solution, data: &Observation) -> Option<Solution> {
    let coarse = data.coarser(QUICK);
    let quick = coarse.as_ref().unwrap_or(data);
    let next = |before: &Solution| {
        let each = CHANGES.iter().filter_map(|c| changed(before, *c, quick));
        let best = each.max_by(|a, b| a.0.total_cmp(&b.0));
        best.filter(|(ahead, _)| misses(before) && *ahead > BEYOND)
    };
    let mut found = next(&again(asked, quick))?.1;
    for _more in 1..MOST {
        let Some((_, better)) = next(&found) else {
            break;
        };
        found = better;
    }
    let after = again(&found, data);
    (ahead(&after, asked, data) > BEYOND).then_some(after)
}

/// Takes a gap back that the readings do not tell from a law without one: the better fit counts, and the stiffness is as
/// uncertain as the two differ. The cause of that law; `None` where the gap is told, or none is there.
fn gap_or(solution: &mut Solution, data: &Observation) -> Option<&'static str> {
    let own = solution.amplitude_of(GAP)?;
    if solution.status[own] != Status::Identified {
        return None;
    }
    let rival = match data.coarser(QUICK) {
        Some(quick) => again(&rival(&again(solution, &quick), &quick)?, data),
        None => rival(solution, data)?,
    };
    let ahead = ahead(&rival, solution, data);
    if ahead < -BEYOND {
        return None;
    }
    let cause = in_its_place(&rival.model)?;
    let apart = (rival.p[0] - solution.p[0]).powi(2);
    let other = 1.0 / (1.0 + ahead.abs().exp());
    if ahead > 0.0 {
        *solution = rival;
    } else {
        solution.status[own] = Status::NotIdentifiable;
    }
    solution.covariance[(0, 0)] += other * apart;
    Some(cause)
}

/// The cause of the law that stands in the place of the gap.
fn in_its_place(model: &Composite) -> Option<&'static str> {
    let comes = |name: &str| model.effects().iter().find(|e| e.card().name == name);
    let mut laws = CHANGES.iter().filter(|(goes, _)| *goes == Some(GAP));
    let gone = model.effects().iter().all(|e| e.card().cause != GAP);
    laws.find_map(|(_, name)| comes(name))
        .filter(|_| gone)
        .map(|e| e.card().cause)
}

/// The best fit without a gap, where no gap is clearly ahead of it.
fn rival(solution: &Solution, data: &Observation) -> Option<Solution> {
    let without = CHANGES.iter().filter(|(goes, _)| *goes == Some(GAP));
    let each = without.filter_map(|c| changed(solution, *c, data));
    let best = each.max_by(|a, b| a.0.total_cmp(&b.0));
    best.filter(|(ahead, _)| *ahead > -BEYOND)
        .map(|(_, rival)| rival)
}

/// The same model fitted to other data of the same joint.
fn again(fitted: &Solution, data: &Observation) -> Solution {
    let ignored = vec![false; data.rows()];
    fit_from(
        &fitted.model,
        data,
        std::slice::from_ref(&fitted.p),
        &ignored,
    )
}

/// The fit after a change, and by how many nats it is ahead of the one before; `None` where the model has nothing to give
/// up, or the law already.
fn changed(
    before: &Solution,
    (goes, comes): (Option<&str>, &str),
    data: &Observation,
) -> Option<(f64, Solution)> {
    let own = before.model.effects();
    let gone = |effect: &dyn Effect| goes.is_some_and(|cause| effect.card().cause == cause);
    let comes = named(comes)?;
    let has = own.iter().any(|e| e.card().name == comes.card().name);
    let lacks = match goes {
        Some(_) => !own.iter().any(|e| gone(*e)),
        None => before.amplitude_of(GAP).is_none(),
    };
    if has || lacks {
        return None;
    }
    let mut effects: Vec<&'static dyn Effect> = own.iter().copied().filter(|e| !gone(*e)).collect();
    let kept = Composite::new(&effects);
    let guess = guess(comes, &kept, &parameters(&kept, before, comes, &[]), data)?;
    if guess.left * guess.without > HOPELESS * before.rms.powi(2) * data.rows() as f64 {
        return None;
    }
    effects.push(comes);
    let model = Composite::new(&effects);
    let start = parameters(&model, before, comes, &guess.p);
    let ignored = vec![false; data.rows()];
    let after = fit_until(&model, data, &[start], &ignored, COMPARED);
    Some((ahead(&after, before, data), after))
}

/// The parameters of a model: what stays as it was before, those of the law that comes as given.
fn parameters(
    model: &Composite,
    before: &Solution,
    comes: &'static dyn Effect,
    given: &[f64],
) -> Vec<f64> {
    let old = before.model.slots();
    let new = comes.card().parameters;
    let each = model.slots().into_iter();
    each.filter_map(|slot| {
        let (effect, name) = (slot.effect.card().name, slot.parameter.name);
        if effect == comes.card().name {
            return new
                .iter()
                .zip(given)
                .find(|(q, _)| q.name == name)
                .map(|(_, v)| *v);
        }
        let is_it = |s: &Slot| s.effect.card().name == effect && s.parameter.name == name;
        old.iter().position(is_it).map(|j| before.p[j])
    })
    .collect()
}
