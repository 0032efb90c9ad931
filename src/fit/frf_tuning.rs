//! Tunes dampings (and released stiffnesses and masses) until simulated FRFs meet measured ones:
//! least squares on the complex accelerance weighted with its variance. Parameters are logarithms
//! within bounds; residual terms of what the model leaves out are eliminated per channel.

use super::frf_data::Measured;
use super::frf_identifiability::Uncertainty;
use super::frf_match::{FrfMatch, frf_match};
use super::frf_model::{Kind, Pose};
use super::frf_nuisance::Pull;
pub use super::frf_parameter::Parameter;
pub use super::frf_residuals::Residuals;
use super::frf_residuals::with_residuals;
use super::frf_solved::solve;
use crate::ground::problem::{Outcome, Problem};

/// A tuning task: shared parameters, several poses.
#[derive(Debug, Clone, PartialEq)]
pub struct Tuning {
    /// The parameters.
    pub parameters: Vec<Parameter>,
    /// The poses.
    pub poses: Vec<Pose>,
    /// Residual terms.
    pub residuals: Residuals,
    /// Number of starts (`frf_starts`); the first is at the first guesses.
    pub starts: usize,
}

/// The outcome.
#[derive(Debug, Clone, PartialEq)]
pub struct Tuned {
    /// Values, SI.
    pub values: Vec<f64>,
    /// What the data say about each of them.
    pub uncertainty: Uncertainty,
    /// Weighted sum of squares over the degrees of freedom, an exponential window counted: 1 is noise
    /// alone.
    pub reduced_chi_square: f64,
    /// Per pose and measured pair, before and after.
    pub matches: Vec<Vec<[FrfMatch; 2]>>,
    /// Share of the starts that reached the best cost (within 1 %).
    pub agreeing_starts: f64,
    /// Where the nuisances went.
    pub pulls: Vec<Pull>,
    /// Whether the model is further from the FRFs than one that never moves.
    pub worse_than_nothing: bool,
}

impl Tuning {
    /// How many parameters are asked for: they stand first.
    pub(super) fn asked_for(&self) -> usize {
        self.parameters.iter().filter(|p| !p.nuisance).count()
    }

    /// The values from what is searched.
    pub(super) fn values(&self, theta: &[f64]) -> Vec<f64> {
        let all = self.parameters.iter().zip(theta);
        all.map(|(parameter, theta)| parameter.value(*theta))
            .collect()
    }

    /// What each parameter multiplies.
    pub fn kinds(&self) -> Vec<Kind> {
        self.parameters.iter().map(|p| p.kind).collect()
    }
}

/// Solves the task.
///
/// # Errors
/// No parameters, no data, wrong bounds, a model without a finite FRF.
pub fn tune(task: &Tuning) -> Outcome<Tuned> {
    Ok(solve(task)?.told(task))
}

pub(super) fn check(task: &Tuning) -> Outcome<()> {
    let sound = |p: &Parameter| p.kind.is_signed() || (p.bounds[0] > 0.0 && p.start > 0.0);
    let wrong = |p: &&Parameter| !(sound(p) && p.bounds[0] < p.bounds[1]);
    if let Some(parameter) = task.parameters.iter().find(wrong) {
        return Err(Problem::new(
            "bounds and first guess must be positive, the lower bound below the upper",
            "correct the range of this constant",
        )
        .in_column(parameter.site.clone()));
    }
    if task.parameters.iter().all(|p| p.nuisance) || rows(task) == 0 {
        return Err(Problem::new(
            "nothing to tune",
            "give parameters and measured FRFs",
        ));
    }
    let loose = |p: &Parameter| p.nuisance && p.prior_ln_std.is_none();
    if !task.parameters.is_sorted_by_key(|p| p.nuisance) || task.parameters.iter().any(loose) {
        return Err(Problem::new(
            "a nuisance has no prior or stands before what is asked for",
            "put nuisances last, each with its prior",
        ));
    }
    Ok(())
}

pub(super) fn singular() -> Problem {
    Problem::new(
        "the model has no finite FRF at these values",
        "check masses and stiffnesses of the robot file: each coordinate needs both",
    )
}

pub(super) fn pairs(task: &Tuning) -> impl Iterator<Item = (&Pose, &Measured)> {
    task.poses
        .iter()
        .flat_map(|pose| pose.measured.iter().map(move |pair| (pose, pair)))
}

fn rows(task: &Tuning) -> usize {
    pairs(task).map(|(_, pair)| 2 * pair.frf.len()).sum()
}

/// Independent real numbers measured, less what was fitted to them. Under an exponential window
/// neighbouring lines repeat each other: the weights count each for its share only, and so does this.
/// A nuisance costs none, as its prior is a measurement too.
pub(super) fn freedom(task: &Tuning) -> f64 {
    let of = |pair: &Measured| {
        2.0 * pair.frf.len() as f64 / pair.lines_per_independent_one()
            - task.residuals.terms() as f64
    };
    let measured: f64 = pairs(task).map(|(_, pair)| of(pair)).sum();
    (measured - task.asked_for() as f64).max(1.0)
}

pub(super) fn matches(task: &Tuning, values: &[f64]) -> Vec<Vec<[FrfMatch; 2]>> {
    let kinds = task.kinds();
    let starts: Vec<f64> = task.parameters.iter().map(|p| p.start).collect();
    let of = |pose: &Pose, pair: &Measured, theta: &[f64]| {
        let simulated = pose.accelerance(&kinds, theta, pair).unwrap_or_default();
        frf_match(&pair.frf, &with_residuals(task.residuals, pair, &simulated))
    };
    let pose = |pose: &Pose| -> Vec<[FrfMatch; 2]> {
        let pairs = pose.measured.iter();
        pairs
            .map(|pair| [of(pose, pair, &starts), of(pose, pair, values)])
            .collect()
    };
    task.poses.iter().map(pose).collect()
}
