//! The most probable amounts and nuisances of a set of causes, and how probable the set is then
//! (Laplace), with a unit prior on everything.

use super::data::Data;
use super::nuisance::Nuisance;
use super::point::Point;
use super::prediction::{Machine, Shown, stack};
use super::suspect::Suspect;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::products::gram;
use crate::inference::descent::{Landscape, Linear, Stop, descend, pushed};
use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

/// Prior probability that one cause is present at some place.
const PRIOR: f64 = 0.03;
/// Logarithm of the prior odds of so many causes.
pub fn ln_odds(causes: usize) -> f64 {
    causes as f64 * (PRIOR / (1.0 - PRIOR)).ln()
}

/// Largest step of an amount (spreads) and of a nuisance (standard deviations).
const LARGEST: [f64; 2] = [1.0, 2.0];
/// A descent has arrived when the cost falls by less than this, nats.
const ARRIVED: f64 = 0.02;

/// A fitted set.
#[derive(Clone)]
pub struct Fit {
    /// Where it ended.
    pub point: Point,
    /// Half the weighted sum of squares of the data alone, nats.
    pub misfit: f64,
    /// That and half the squares of all amounts and nuisances.
    pub cost: f64,
    /// Log evidence at noise as stated, the causes' prior odds included.
    pub evidence: f64,
    /// Precision of nuisances and amounts: JᵀJ + 1.
    pub precision: DMatrix<f64>,
    /// What is left, weighted.
    pub residual: DVector<f64>,
    /// Weighted slopes.
    pub slopes: DMatrix<f64>,
}

/// A point with what it leaves, and its weighted slopes with their normal matrix once asked for.
struct Here {
    point: Point,
    shown: Shown,
    residual: DVector<f64>,
    cost: f64,
    slopes: Option<(DMatrix<f64>, DMatrix<f64>)>,
}

/// The cost of amounts and nuisances, nats.
struct Cost<'a> {
    machine: &'a Machine<'a>,
    nuisance: Nuisance,
    data: &'a Data,
    weights: Vec<f64>,
}

/// A descent on its way: how probable its set is nobody has asked yet.
pub struct Way<'a> {
    cost: Cost<'a>,
    here: Here,
}

/// Descends from `start` by at most `steps` steps.
///
/// # Errors
/// A robot that cannot stand or a singular model.
pub fn fit(machine: &Machine, data: &Data, start: Point, steps: usize) -> Outcome<Fit> {
    begin(machine, data, start, steps)?.finish()
}

/// The same, where only the cost matters so far.
///
/// # Errors
/// A robot that cannot stand or a singular model.
pub fn begin<'a>(
    machine: &'a Machine,
    data: &'a Data,
    start: Point,
    steps: usize,
) -> Outcome<Way<'a>> {
    let cost = Cost {
        nuisance: machine.nuisance(&start)?,
        machine,
        data,
        weights: weights(data),
    };
    let mut point = start;
    point.theta.resize(cost.nuisance.len(), 0.0);
    let here = cost.at(point)?;
    Ok(Way { cost, here }.further(steps))
}

impl Way<'_> {
    /// The cost where it stands.
    pub fn cost(&self) -> f64 {
        self.here.cost
    }

    /// So many steps further.
    #[must_use]
    pub fn further(self, steps: usize) -> Self {
        let stop = Stop {
            steps,
            gain: ARRIVED,
            share: 0.0,
            promise: ARRIVED,
        };
        let here = descend(&self.cost, self.here, stop);
        Self { here, ..self }
    }

    /// What is found there.
    ///
    /// # Errors
    /// A singular model.
    pub fn finish(self) -> Outcome<Fit> {
        self.cost.finish(self.here)
    }
}

/// Weights of all rows.
pub fn weights(data: &Data) -> Vec<f64> {
    let pairs = data.pairs.iter();
    pairs
        .flat_map(|p| p.weight.iter().flat_map(|w| [*w, *w]))
        .collect()
}

/// The measured rows of `data`.
pub fn measured(data: &Data) -> Vec<f64> {
    let pairs = data.pairs.iter();
    pairs
        .flat_map(|p| p.frf.iter().flat_map(|h| [h.re, h.im]))
        .collect()
}

impl Cost<'_> {
    fn at(&self, point: Point) -> Outcome<Here> {
        let mut rows = Vec::with_capacity(self.data.rows());
        let shown = self.machine.show(&self.nuisance, &point, self.data)?;
        stack(self.data, &shown.values, &mut rows);
        let residual = measured(self.data)
            .iter()
            .zip(&rows)
            .zip(&self.weights)
            .map(|((m, p), w)| (m - p) * w)
            .collect();
        let residual = DVector::from_vec(residual);
        let prior: f64 = unknowns(&point).map(|x| x * x).sum();
        let cost = 0.5 * (residual.norm_squared() + prior);
        match cost.is_finite() {
            true => Ok(Here {
                point,
                shown,
                residual,
                cost,
                slopes: None,
            }),
            false => Err(singular()),
        }
    }

    fn slopes(&self, here: &Here) -> Outcome<(DMatrix<f64>, DMatrix<f64>)> {
        let Here { point, shown, .. } = here;
        let slopes = self.machine.slopes(&self.nuisance, point, self.data, shown);
        let mut columns = slopes?.columns;
        for mut column in columns.column_iter_mut() {
            let rows = column.iter_mut().zip(&self.weights);
            rows.for_each(|(x, w)| *x *= w);
        }
        let mut normal = gram(&columns);
        (0..normal.nrows()).for_each(|i| normal[(i, i)] += 1.0);
        Ok((columns, normal))
    }

    fn finish(self, here: Here) -> Outcome<Fit> {
        let (slopes, precision) = match here.slopes {
            Some(slopes) => slopes,
            None => self.slopes(&here)?,
        };
        let mut fit = Fit {
            misfit: 0.5 * here.residual.norm_squared(),
            point: here.point,
            cost: here.cost,
            evidence: 0.0,
            precision,
            residual: here.residual,
            slopes,
        };
        fit.evidence = fit.evidence_at(1.0).ok_or_else(singular)?;
        Ok(fit)
    }
}

/// Nuisances, then amounts.
pub fn unknowns(point: &Point) -> impl Iterator<Item = f64> {
    point.theta.iter().chain(&point.amounts).copied()
}

impl Landscape for Cost<'_> {
    type Place = Here;

    fn height(&self, place: &Here) -> f64 {
        place.cost
    }

    fn linear(&self, place: &mut Here) -> Option<Linear> {
        let (slopes, normal) = self.slopes(place).ok()?;
        let own = DVector::from_iterator(normal.nrows(), unknowns(&place.point));
        let linear = Linear {
            slope: slopes.tr_mul(&place.residual) - own,
            normal: normal.clone(),
        };
        place.slopes = Some((slopes, normal));
        Some(linear)
    }

    fn step(&self, from: &Here, step: &DVector<f64>) -> Option<Here> {
        let (mut point, bounds) = (from.point.clone(), from.point.bounds());
        let (nuisances, amounts) = step.as_slice().split_at(point.theta.len());
        for (x, change) in point.theta.iter_mut().zip(nuisances) {
            *x += change.clamp(-LARGEST[1], LARGEST[1]);
        }
        for ((x, change), [low, high]) in point.amounts.iter_mut().zip(amounts).zip(bounds) {
            *x = (*x + change.clamp(-LARGEST[0], LARGEST[0])).clamp(low, high);
        }
        self.at(point).ok()
    }

    fn held(&self, at: &Here, i: usize, slope: f64) -> bool {
        let amount = i.checked_sub(at.point.theta.len());
        amount.is_some_and(|k| pushed(at.point.amounts[k], at.point.bounds()[k], slope))
    }
}

pub(super) fn singular() -> Problem {
    Problem::new(
        "the model has no finite FRF",
        "check masses and stiffnesses of the robot file",
    )
}

impl Fit {
    /// Log evidence when only the share `temper` of every squared residual counts.
    pub fn evidence_at(&self, temper: f64) -> Option<f64> {
        let prior = self.cost - self.misfit;
        let kept = self.kept();
        let precision = DMatrix::from_fn(kept.len(), kept.len(), |i, j| {
            let one = f64::from(u8::from(i == j));
            temper * (self.precision[(kept[i], kept[j])] - one) + one
        });
        let spread = log_determinant(&precision.cholesky()?);
        let choices: f64 = self.point.set.iter().map(Suspect::choices).sum();
        let odds = ln_odds(self.point.set.len()) - choices;
        Some(-temper * self.misfit - prior - 0.5 * spread + odds)
    }

    /// Amounts on a bound cost no volume.
    fn kept(&self) -> Vec<usize> {
        let (nuisances, bounds) = (self.point.theta.len(), self.point.bounds());
        let inside = |i: &usize| match i.checked_sub(nuisances) {
            None => true,
            Some(k) => {
                let x = self.point.amounts[k];
                x > bounds[k][0] && x < bounds[k][1]
            }
        };
        (0..self.precision.nrows()).filter(inside).collect()
    }

    /// Nats that one more column (weighted rows) would explain, everything else following, when its
    /// amount may be at most `most` either way; and that amount.
    pub fn promise(&self, column: &DVector<f64>, most: f64) -> (f64, f64) {
        let Some(factor) = self.precision.clone().cholesky() else {
            return (0.0, 0.0);
        };
        let across = self.slopes.tr_mul(column);
        let own = column.norm_squared() - across.dot(&factor.solve(&across));
        let x: Vec<f64> = unknowns(&self.point).collect();
        let slope = self.slopes.tr_mul(&self.residual) - DVector::from_vec(x);
        let pull = column.dot(&self.residual) - across.dot(&factor.solve(&slope));
        let amount = (pull / own.max(1e-12)).clamp(-most, most);
        (amount * pull - 0.5 * amount * amount * own, amount)
    }
}

fn log_determinant(factor: &Cholesky<f64, Dyn>) -> f64 {
    let lower = factor.l_dirty();
    (0..lower.nrows()).map(|i| 2.0 * lower[(i, i)].ln()).sum()
}
