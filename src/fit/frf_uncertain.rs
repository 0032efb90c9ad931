//! Bodies and instruments that are fitted along with the dampings: no laboratory knows a mass to the last
//! gram, and no calibration is exact.

use super::frf_linear::linearise;
use super::frf_model::{Kind, Uncertain};
use super::frf_tuning::{Parameter, Tuning, singular};
use crate::ground::problem::Outcome;
use crate::motion::uncertain::bodies;
use crate::motion::uncertain::instrument::{NUMBERS, SHARED};
use nalgebra::DMatrix;

/// Combinations of the bodies' numbers that move the FRFs by less than this many standard deviations of
/// their noise are left out.
const UNSEEN: f64 = 0.3;
/// At most this many combinations are kept.
const MOST: usize = 40;
/// Furthest that a number goes from what is stated, standard deviations.
const FURTHEST: f64 = 20.0;

/// The task with what is uncertain about the bodies, in the combinations that its FRFs see, and about the
/// instruments of every pose.
///
/// # Errors
/// A model without a finite FRF at the first guesses.
pub(super) fn uncertain(mut task: Tuning) -> Outcome<Tuning> {
    for (number, pose) in task.poses.iter_mut().enumerate() {
        pose.uncertain.iter_mut().for_each(|own| own.pose = number);
    }
    let known = task.poses.iter().filter_map(|pose| pose.uncertain.as_ref());
    let numbers = known.map(|known| known.bodies.nrows()).max().unwrap_or(0);
    let seen = combinations(with(task.clone(), Kind::Body, numbers), numbers)?;
    for own in task
        .poses
        .iter_mut()
        .filter_map(|pose| pose.uncertain.as_mut())
    {
        *own = Uncertain {
            bodies: &seen * &own.bodies,
            ..own.clone()
        };
    }
    let task = with(task, Kind::Body, seen.nrows());
    let instruments = SHARED + (NUMBERS - SHARED) * task.poses.len();
    Ok(with(task, Kind::Instrument, instruments))
}

/// The combinations that the FRFs of a task with all numbers see, by the slopes at the first guesses.
fn combinations(task: Tuning, numbers: usize) -> Outcome<DMatrix<f64>> {
    let first: Vec<f64> = (task.parameters.iter())
        .map(|p| p.coordinate(p.start))
        .collect();
    let normal = linearise(&task, &first).ok_or_else(singular)?.normal;
    let from = normal.nrows() - numbers;
    let own = normal.view((from, from), (numbers, numbers));
    let information = own - DMatrix::identity(numbers, numbers);
    Ok(bodies::seen(information, UNSEEN, MOST))
}

/// The task with so many more nuisances of one kind, in standard deviations.
fn with(mut task: Tuning, kind: Kind, count: usize) -> Tuning {
    let number = |site: usize| Parameter {
        site: site.to_string(),
        kind,
        start: 0.0,
        bounds: [-FURTHEST, FURTHEST],
        prior_ln_std: Some(1.0),
        nuisance: true,
    };
    task.parameters.extend((0..count).map(number));
    let none = || DMatrix::zeros(0, 0);
    let poses = task.poses.iter_mut();
    poses.for_each(|pose| pose.directions.extend((0..count).map(|_| none())));
    task
}
