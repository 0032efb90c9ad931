//! Levenberg-Marquardt descents on a tuning task, with parameters that stop at their bounds.

use super::frf_linear::{Linearised, linearise};
use super::frf_tuning::{Parameter, Tuning};
use nalgebra::{DMatrix, DVector};

/// Where a descent ended: logarithms and cost.
pub(super) type Run = (Vec<f64>, f64);

/// Gain as a share of the cost from which on a search goes on: a model that misses by far is not tuned to the
/// last digit, and its intervals are wider by as much.
const SHARE: f64 = 1e-6;

/// When a search ends: after so many steps, or once one gains less than this.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stop {
    /// Steps at most.
    pub(super) steps: usize,
    /// Least gain in cost.
    pub(super) gain: f64,
}

/// Levenberg-Marquardt, steps cut at the bounds.
pub(super) fn descend(task: &Tuning, theta: Vec<f64>, stop: Stop) -> Option<Run> {
    descend_by(task, theta, stop, |theta| linearise(task, theta))
}

/// The same with the normal equations of `linearised`.
pub(super) fn descend_by(
    task: &Tuning,
    mut theta: Vec<f64>,
    stop: Stop,
    linearised: impl Fn(&[f64]) -> Option<Linearised>,
) -> Option<Run> {
    let mut at = linearised(&theta)?;
    let mut brake = 1e-3;
    for _ in 0..stop.steps {
        let before = at.cost;
        while brake < 1e10 {
            let trial = stepped(task, &theta, &at, brake);
            let found = trial.and_then(|trial| Some((linearised(&trial)?, trial)));
            if let Some((lower, trial)) = found.filter(|(found, _)| found.cost < at.cost) {
                (at, theta) = (lower, trial);
                brake = (0.1 * brake).max(1e-10);
                break;
            }
            brake *= 10.0;
        }
        if before - at.cost <= stop.gain.max(SHARE * before) {
            break;
        }
    }
    Some((theta, at.cost))
}

/// A damped step; parameters that push against a bound stay there.
fn stepped(task: &Tuning, theta: &[f64], at: &Linearised, brake: f64) -> Option<Vec<f64>> {
    let bounds: Vec<[f64; 2]> = task.parameters.iter().map(Parameter::ends).collect();
    let bound = |i: usize, side: usize| bounds[i][side];
    let held = |i: &usize| {
        (at.slope[*i] < 0.0 && theta[*i] <= bound(*i, 0))
            || (at.slope[*i] > 0.0 && theta[*i] >= bound(*i, 1))
    };
    let free: Vec<usize> = (0..theta.len()).filter(|i| !held(i)).collect();
    let largest = at.normal.diagonal().max().max(1e-300);
    let damped = DMatrix::from_fn(free.len(), free.len(), |i, j| {
        let entry = at.normal[(free[i], free[j])];
        if i == j {
            entry * (1.0 + brake) + 1e-12 * largest
        } else {
            entry
        }
    });
    let slope = DVector::from_iterator(free.len(), free.iter().map(|i| at.slope[*i]));
    let step = damped.cholesky()?.solve(&slope);
    let mut next = theta.to_vec();
    for (i, change) in free.iter().zip(step.iter()) {
        next[*i] = (theta[*i] + change.clamp(-1.5, 1.5)).clamp(bound(*i, 0), bound(*i, 1));
    }
    Some(next)
}
