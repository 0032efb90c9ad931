//! Descents on a tuning task, with parameters that stop at their bounds.

use super::frf_linear::{Linearised, linearise};
use super::frf_tuning::{Parameter, Tuning};
use crate::inference::descent::{self, Landscape, Linear, Stop, pushed};
use nalgebra::DVector;

/// Where a descent ended: logarithms and cost.
pub(super) type Run = (Vec<f64>, f64);

/// Gain as a share of the cost from which on a search goes on: a model that misses by far is not tuned to the
/// last digit, and its intervals are wider by as much.
pub(super) const SHARE: f64 = 1e-6;
/// Largest step of a logarithm.
const LARGEST: f64 = 1.5;

/// From `theta`.
pub(super) fn descend(task: &Tuning, theta: Vec<f64>, stop: Stop) -> Option<Run> {
    descend_by(task, theta, stop, |theta| linearise(task, theta))
}

/// The same with the normal equations of `linearised`.
pub(super) fn descend_by(
    task: &Tuning,
    theta: Vec<f64>,
    stop: Stop,
    linearised: impl Fn(&[f64]) -> Option<Linearised>,
) -> Option<Run> {
    let bounds = task.parameters.iter().map(Parameter::ends).collect();
    let along = Along { bounds, linearised };
    let at = linearised_at(&along, theta)?;
    let (theta, lowest) = descent::descend(&along, at, stop);
    Some((theta, lowest.cost))
}

struct Along<F> {
    bounds: Vec<[f64; 2]>,
    linearised: F,
}

fn linearised_at<F: Fn(&[f64]) -> Option<Linearised>>(
    along: &Along<F>,
    theta: Vec<f64>,
) -> Option<(Vec<f64>, Linearised)> {
    let found = (along.linearised)(&theta)?;
    Some((theta, found))
}

impl<F: Fn(&[f64]) -> Option<Linearised>> Landscape for Along<F> {
    type Place = (Vec<f64>, Linearised);

    fn height(&self, place: &Self::Place) -> f64 {
        place.1.cost
    }

    fn linear(&self, place: &mut Self::Place) -> Option<Linear> {
        Some(Linear {
            normal: place.1.normal.clone(),
            slope: place.1.slope.clone(),
        })
    }

    fn step(&self, (theta, _): &Self::Place, step: &DVector<f64>) -> Option<Self::Place> {
        let parts = theta.iter().zip(step.iter()).zip(&self.bounds);
        let moved = parts.map(|((x, d), b)| (x + d.clamp(-LARGEST, LARGEST)).clamp(b[0], b[1]));
        linearised_at(self, moved.collect())
    }

    fn held(&self, (theta, _): &Self::Place, i: usize, slope: f64) -> bool {
        pushed(theta[i], self.bounds[i], slope)
    }
}
