//! What a wrong law does to the parameters. No law is exact: what a fit leaves along functions of the load, beyond the
//! noise, is the law's error, and the part of it that the parameters took cannot be seen. A thousand readings of one
//! wrong law are no thousand witnesses: each function of the load is one.

use super::least_squares::Problem;
use super::observation::Observation;
use super::other_law::GAP;
use super::parameter::Status;
use super::screen::{laws, orthonormal};
use super::solution::{Solution, UNSUPPORTED};
use crate::signal::colour::Colour;
use nalgebra::{DMatrix, DVector};

/// Deviations of chance above which what is left along the functions of the load is the law's.
const BEYOND: f64 = 4.0;

/// Widens the covariance of a solution by the error of its law: every function of the load is taken to hold as much of
/// it as those that no parameter follows show (Kennedy and O'Hagan 2001, with as many terms as the load has). `noise`:
/// that of the readings, independent of the model.
pub fn widen(solution: &mut Solution, data: &Observation, noise: &Colour) {
    let basis = orthonormal(&laws(data));
    let free = solution
        .covariance
        .diagonal()
        .iter()
        .filter(|v| **v > 0.0)
        .count();
    let Some(variance) = variance(&basis, free, &solution.residual, data, noise) else {
        return;
    };
    add(&basis, variance, solution, data);
}

/// Causes that saturate, and how many of their amplitudes one side of zero takes: amplitude first, then the load at which.
const SATURATING: [(&str, f64); 2] = [(GAP, 0.5), ("soft_zone", 1.0)];

/// Widens the covariance of a fit with a gap or a soft zone by what is not known of how flanks close: that is a law like
/// another, and the size and the spring beside it are read off its tails. One deviation is what lies between flanks that close
/// by a power of the load and such that close exponentially.
pub fn widen_by_flanks(solution: &mut Solution, data: &Observation) {
    for (cause, share) in SATURATING {
        let Some(own) = solution.amplitude_of(cause) else {
            continue;
        };
        let (side, at) = (share * solution.p[own], solution.p[own + 1]);
        let between = |load: &f64| {
            let x = load / at;
            side * (x.tanh() - x / x.hypot(1.0))
        };
        let column: Vec<f64> = data.scene.load.iter().map(between).collect();
        let column = DMatrix::from_vec(data.rows(), 1, column);
        add(&column, 1.0, solution, data);
    }
}

/// Adds what errors of this variance along each of these functions do to the parameters.
fn add(functions: &DMatrix<f64>, variance: f64, solution: &mut Solution, data: &Observation) {
    let problem = Problem {
        model: &solution.model,
        data,
        colour: &solution.colour,
        ignored: &vec![false; data.rows()],
    };
    let scale = problem.scale();
    let (_, mut jacobian) = problem.linearise(&solution.p, &scale);
    for (mut column, scale) in jacobian.column_iter_mut().zip(&scale) {
        column /= *scale;
    }
    let mut whitened = turned(functions, data);
    for mut column in whitened.column_iter_mut() {
        solution.colour.whiten(column.as_mut_slice());
    }
    let pull = jacobian.tr_mul(&whitened);
    for covariance in [&mut solution.covariance, &mut solution.reach] {
        let moved = finite(covariance) * &pull;
        *covariance += &moved * moved.transpose() * variance;
    }
    let far = solution.stderr(0) > UNSUPPORTED * solution.p[0].abs();
    if far && solution.status[0] == Status::Identified {
        solution.status[0] = Status::NotIdentifiable;
    }
}

/// Variance of the law's error along each function, beyond the noise; `None` where chance explains what is left.
fn variance(
    basis: &DMatrix<f64>,
    free: usize,
    residual: &[f64],
    data: &Observation,
    noise: &Colour,
) -> Option<f64> {
    let left = basis.ncols().checked_sub(free).filter(|left| *left > 0)? as f64;
    let seen = basis.tr_mul(&DVector::from_column_slice(residual));
    let mut by_chance = turned(basis, data);
    for mut column in by_chance.column_iter_mut() {
        column
            .iter_mut()
            .zip(&noise.sigma)
            .for_each(|(c, s)| *c *= s);
    }
    let expected = by_chance.norm_squared() / basis.ncols() as f64;
    let each = seen.norm_squared() / left;
    (each > expected * (1.0 + BEYOND * (2.0 / left).sqrt())).then_some(each - expected)
}

/// The columns in the cosine domain.
fn turned(columns: &DMatrix<f64>, data: &Observation) -> DMatrix<f64> {
    let mut turned = columns.clone();
    for mut column in turned.column_iter_mut() {
        data.cosine.transform(column.as_mut_slice());
    }
    turned
}

/// A covariance without what the data do not see.
fn finite(covariance: &DMatrix<f64>) -> DMatrix<f64> {
    covariance.map(|v| if v.is_finite() { v } else { 0.0 })
}
