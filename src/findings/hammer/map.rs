//! The most probable amounts and nuisances of a set of causes, and how probable the set is then
//! (Laplace): Levenberg and Marquardt's descent with a unit prior on everything.

use super::data::Data;
use super::nuisance::Nuisance;
use super::prediction::{Machine, Point, stack};
use crate::ground::problem::{Outcome, Problem};
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
    /// Matrices of the nuisances.
    pub nuisance: Nuisance,
}

struct Here {
    point: Point,
    residual: DVector<f64>,
    cost: f64,
}

/// Descends from `start` by at most `steps` steps.
///
/// # Errors
/// A robot that cannot stand or a singular model.
pub fn fit(machine: &Machine, data: &Data, start: Point, steps: usize) -> Outcome<Fit> {
    let nuisance = machine.nuisance(&start)?;
    let mut point = start;
    point.theta.resize(nuisance.len(), 0.0);
    let weights = weights(data);
    let mut here = look(machine, &nuisance, data, &weights, point)?;
    let (mut slopes, mut normal) = slopes(machine, &nuisance, data, &weights, &here)?;
    let mut brake = 1e-3;
    for _ in 0..steps {
        let before = here.cost;
        while brake < 1e7 {
            let next = step(&here, &slopes, &normal, brake)
                .and_then(|next| look(machine, &nuisance, data, &weights, next).ok());
            if let Some(next) = next.filter(|next| next.cost < here.cost) {
                here = next;
                brake = (0.1 * brake).max(1e-6);
                break;
            }
            brake *= 10.0;
        }
        if before - here.cost > 0.0 {
            (slopes, normal) = self::slopes(machine, &nuisance, data, &weights, &here)?;
        }
        if before - here.cost < ARRIVED {
            break;
        }
    }
    finish(here, slopes, normal, nuisance)
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

fn look(
    machine: &Machine,
    nuisance: &Nuisance,
    data: &Data,
    weights: &[f64],
    point: Point,
) -> Outcome<Here> {
    let mut rows = Vec::with_capacity(data.rows());
    stack(data, &machine.predict(nuisance, &point, data)?, &mut rows);
    let residual = measured(data)
        .iter()
        .zip(&rows)
        .zip(weights)
        .map(|((m, p), w)| (m - p) * w)
        .collect();
    let residual = DVector::from_vec(residual);
    let prior: f64 = point
        .theta
        .iter()
        .chain(&point.amounts)
        .map(|x| x * x)
        .sum();
    let cost = 0.5 * (residual.norm_squared() + prior);
    match cost.is_finite() {
        true => Ok(Here {
            point,
            residual,
            cost,
        }),
        false => Err(singular()),
    }
}

fn singular() -> Problem {
    Problem::new(
        "the model has no finite FRF",
        "check masses and stiffnesses of the robot file",
    )
}

fn slopes(
    machine: &Machine,
    nuisance: &Nuisance,
    data: &Data,
    weights: &[f64],
    here: &Here,
) -> Outcome<(DMatrix<f64>, DMatrix<f64>)> {
    let mut columns = machine.slopes(nuisance, &here.point, data)?.columns;
    for mut column in columns.column_iter_mut() {
        column.iter_mut().zip(weights).for_each(|(x, w)| *x *= w);
    }
    let normal = columns.transpose() * &columns;
    Ok((columns, normal))
}

/// A damped step; amounts that push against a bound stay there.
fn step(here: &Here, slopes: &DMatrix<f64>, normal: &DMatrix<f64>, brake: f64) -> Option<Point> {
    let (nuisances, bounds) = (here.point.theta.len(), here.point.bounds());
    let x: Vec<f64> = here
        .point
        .theta
        .iter()
        .chain(&here.point.amounts)
        .copied()
        .collect();
    let slope = slopes.tr_mul(&here.residual) - DVector::from_column_slice(&x);
    let held = |i: &usize| {
        let Some(k) = i.checked_sub(nuisances) else {
            return false;
        };
        (slope[*i] < 0.0 && x[*i] <= bounds[k][0]) || (slope[*i] > 0.0 && x[*i] >= bounds[k][1])
    };
    let free: Vec<usize> = (0..x.len()).filter(|i| !held(i)).collect();
    let damped = DMatrix::from_fn(free.len(), free.len(), |i, j| {
        let entry = normal[(free[i], free[j])];
        if i == j {
            (entry + 1.0) * (1.0 + brake)
        } else {
            entry
        }
    });
    let right = DVector::from_iterator(free.len(), free.iter().map(|i| slope[*i]));
    let change = damped.cholesky()?.solve(&right);
    let mut point = here.point.clone();
    for (i, change) in free.iter().zip(change.iter()) {
        match i.checked_sub(nuisances) {
            None => point.theta[*i] += change.clamp(-LARGEST[1], LARGEST[1]),
            Some(k) => {
                let next = point.amounts[k] + change.clamp(-LARGEST[0], LARGEST[0]);
                point.amounts[k] = next.clamp(bounds[k][0], bounds[k][1]);
            }
        }
    }
    Some(point)
}

fn finish(
    here: Here,
    slopes: DMatrix<f64>,
    mut normal: DMatrix<f64>,
    nuisance: Nuisance,
) -> Outcome<Fit> {
    for i in 0..normal.nrows() {
        normal[(i, i)] += 1.0;
    }
    let misfit = 0.5 * here.residual.norm_squared();
    let mut fit = Fit {
        point: here.point,
        misfit,
        cost: here.cost,
        evidence: 0.0,
        precision: normal,
        residual: here.residual,
        slopes,
        nuisance,
    };
    fit.evidence = fit.evidence_at(1.0).ok_or_else(singular)?;
    Ok(fit)
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
        let odds = ln_odds(self.point.set.len());
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
        let x: Vec<f64> = self
            .point
            .theta
            .iter()
            .chain(&self.point.amounts)
            .copied()
            .collect();
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
