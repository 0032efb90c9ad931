//! What a record does over time whatever the load does: a slip, a drift, a zero. None of them is the
//! joint's, and each would be taken for lost motion or friction: they are fitted beside the joint where the
//! readings demand them, and taken off.

use super::candidates::{Atom, Candidates};
use super::comparison::{self, BEYOND, misses, nats};
use super::least_squares::Problem;
use super::observation::Observation;
use super::off_centre::off_centre;
use super::solution::{Solution, fit, fit_from};
use crate::effects::{Composite, Effect, named};
use crate::ground::stats::rms;
use crate::signal::colour::Colour;
use nalgebra::{DMatrix, DVector};

/// Courses that are tried, by the names of their effects.
const COURSES: [&str; 3] = ["sensor_offset", "thermal_drift", "slip"];
/// Most that are taken off together.
const MOST: usize = 2;
/// Least size of a course, as a share of the readings' own (rms): a sixth of what a lever is known to
/// (`LEVER_REL_STD`), so that no stiffness is moved by what a million rows may show.
const MATERIAL: f64 = 5e-4;

/// The fit of a model with the courses that the readings demand, and what these are called; the readings are
/// less by them after that.
pub fn fit_beside(model: &Composite, data: &mut Observation) -> (Solution, Vec<&'static str>) {
    let fitted = fit(model, data);
    let mut best = off_centre(&fitted, data).unwrap_or(fitted);
    let own = best.model.clone();
    let mut taken: Vec<&'static dyn Effect> = Vec::new();
    while taken.len() < MOST && misses(&best) {
        let Some((effect, better)) = next(&best, data) else {
            break;
        };
        taken.push(effect);
        best = better;
    }
    let names: Vec<&'static str> = taken.iter().map(|e| e.card().name).collect();
    match names.is_empty() {
        true => (best, names),
        false => (less(best, &own, data), names),
    }
}

/// The course that helps most, if one helps.
fn next(before: &Solution, data: &Observation) -> Option<(&'static dyn Effect, Solution)> {
    let own = before.model.effects();
    let others = COURSES.iter().filter_map(|name| named(name));
    let others = others.filter(|e| own.iter().all(|o| o.card().name != e.card().name));
    let with = |effect: &'static dyn Effect| {
        let all: Vec<&'static dyn Effect> = own.iter().copied().chain([effect]).collect();
        let model = Composite::new(&all);
        let fits = model.len() <= crate::effects::contract::MOST;
        let guess = fits.then(|| guess(effect, &before.model, &before.p, data))??;
        let most = -0.5 * data.rows() as f64 * guess.left.max(f64::MIN_POSITIVE).ln();
        let start: Vec<f64> = before.p.iter().copied().chain(guess.p).collect();
        let ignored = vec![false; data.rows()];
        let after = || fit_from(&model, data, &[start], &ignored);
        (most > price(effect, data)).then(|| (effect, after()))
    };
    let worth = |(effect, after): (&'static dyn Effect, Solution)| {
        let nats = nats(&before.colour, &after.colour) - price(effect, data);
        let size = rms(&beside(&after, &before.model, data).1);
        let holds = nats > 0.0 && size > MATERIAL * rms(&data.reading);
        holds.then_some((nats, effect, after))
    };
    let each = others.filter_map(with).filter_map(worth);
    let best = each.max_by(|a, b| a.0.total_cmp(&b.0));
    best.map(|(_, effect, after)| (effect, after))
}

/// Nats that a course costs.
fn price(effect: &dyn Effect, data: &Observation) -> f64 {
    BEYOND + comparison::price(effect.card().parameters.len() as f64, data.rows())
}

/// Where a fit with one more effect begins.
pub(super) struct Guess {
    /// Parameters of the effect.
    pub p: Vec<f64>,
    /// Sum of squares that its curve leaves, over that without it, both by the linear model about the one before.
    pub left: f64,
    /// Sum of squares without it.
    pub without: f64,
}

/// The curve of one more effect that lowers the sum of squares of a model most.
pub(super) fn guess(
    effect: &'static dyn Effect,
    before: &Composite,
    p: &[f64],
    data: &Observation,
) -> Option<Guess> {
    let problem = Problem {
        model: before,
        data,
        colour: &Colour::white(data.rows(), 1.0),
        ignored: &vec![false; data.rows()],
    };
    let (residual, jacobian) = problem.linearise(p, &problem.scale());
    let basis = jacobian.qr().q();
    let beside = |v: &DVector<f64>| v - &basis * basis.tr_mul(v);
    let own = beside(&residual);
    let candidates = Candidates::new(&[effect], data);
    let gain = |atom: Atom| {
        let column = beside(&DVector::from_vec(atom.column));
        let amount = column.dot(&own) / column.norm_squared().max(f64::MIN_POSITIVE);
        let possible = amount > 0.0 || !atom.one_signed;
        possible.then(|| (amount * column.dot(&own), amount, atom.p))
    };
    let best = candidates.atoms.into_iter().filter_map(gain);
    let (gain, amount, mut p) = best.max_by(|a, b| a.0.total_cmp(&b.0))?;
    p[0] = amount;
    let without = own.norm_squared();
    Some(Guess {
        p,
        left: 1.0 - gain / without,
        without,
    })
}

/// The places of a smaller model's parameters in those of a solution, and what the rest adds to the readings.
fn beside(all: &Solution, model: &Composite, data: &Observation) -> (Vec<usize>, Vec<f64>) {
    let slots = all.model.slots();
    let kept: Vec<usize> = (0..slots.len())
        .filter(|j| {
            let name = slots[*j].effect.card().name;
            model.effects().iter().any(|e| e.card().name == name)
        })
        .collect();
    let p: Vec<f64> = kept.iter().map(|j| all.p[*j]).collect();
    let whole = all.model.predict(&all.p, &data.scene);
    let own = model.predict(&p, &data.scene);
    let rest = whole.iter().zip(own).map(|(whole, own)| whole - own);
    (kept, rest.collect())
}

/// The solution in the parameters of a smaller model, the rest taken off the readings.
fn less(all: Solution, model: &Composite, data: &mut Observation) -> Solution {
    let (kept, rest) = beside(&all, model, data);
    let p: Vec<f64> = kept.iter().map(|j| all.p[*j]).collect();
    for (reading, rest) in data.reading.iter_mut().zip(&rest) {
        *reading -= rest;
    }
    let part =
        |m: &DMatrix<f64>| DMatrix::from_fn(kept.len(), kept.len(), |i, j| m[(kept[i], kept[j])]);
    Solution {
        model: model.clone(),
        covariance: part(&all.covariance),
        reach: part(&all.reach),
        status: kept.iter().map(|j| all.status[*j]).collect(),
        p,
        ..all
    }
}
