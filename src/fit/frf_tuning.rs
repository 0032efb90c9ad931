//! Tunes dampings (and released stiffnesses and masses) until simulated FRFs meet measured ones:
//! least squares on the complex accelerance weighted with its variance. Parameters are logarithms
//! within bounds; residual terms of what the model leaves out are eliminated per channel.

use super::frf_identifiability::{Uncertainty, uncertainty};
use super::frf_match::{FrfMatch, frf_match};
use super::frf_model::{Kind, Measured, Pose};
use super::frf_nuisance::{Pull, pulls};
pub use super::frf_residuals::Residuals;
use super::frf_residuals::{residual_basis, with_residuals};
use super::frf_starts::starts;
use crate::ground::problem::{Outcome, Problem};
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;
use rustfft::num_complex::Complex64;

/// One parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter {
    /// Where it acts, as in `A6`, `A6-tilt`, `base`.
    pub site: String,
    /// What it multiplies.
    pub kind: Kind,
    /// First guess, SI.
    pub start: f64,
    /// Lowest and highest value, SI, positive.
    pub bounds: [f64; 2],
    /// Standard deviation of the logarithm about `start`, where a prior is stated.
    pub prior_ln_std: Option<f64>,
    /// Whether it is only fitted along, with its prior: what is said of the others holds its
    /// uncertainty, of itself nothing is said. Such parameters stand last.
    pub nuisance: bool,
}

/// Weighted sum of squares within which another minimum explains the data as well as the best: four
/// standard deviations. Springs in series about nearly the same axis have two solutions for their
/// dampings, which only the third order in frequency tells apart.
const RIVAL: f64 = 16.0;

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
}

/// Residuals and Jacobian at one place.
pub(super) struct Linearised {
    pub(super) normal: DMatrix<f64>,
    pub(super) slope: DVector<f64>,
    pub(super) cost: f64,
}

/// Solves the task.
pub fn tune(task: &Tuning) -> Outcome<Tuned> {
    check(task)?;
    let kinds: Vec<Kind> = task.parameters.iter().map(|p| p.kind).collect();
    let descents = starts(task, &kinds)
        .into_par_iter()
        .map(|start| descend(task, &kinds, start));
    let runs: Vec<(Vec<f64>, f64)> = descents.collect::<Vec<_>>().into_iter().flatten().collect();
    let best = runs.iter().min_by(|a, b| a.1.total_cmp(&b.1));
    let (theta, cost) = best.ok_or_else(singular)?;
    let agreeing = runs
        .iter()
        .filter(|run| run.1 <= 1.01 * cost + 1e-12)
        .count();
    let at = linearise(task, &kinds, theta).ok_or_else(singular)?;
    let freedom = freedom(task);
    let values: Vec<f64> = theta.iter().map(|t| t.exp()).collect();
    let reduced = at.cost / freedom;
    let rivals: Vec<&[f64]> = runs
        .iter()
        .filter(|run| run.1 <= cost + RIVAL * reduced.max(1.0))
        .map(|run| run.0.as_slice())
        .collect();
    Ok(Tuned {
        uncertainty: uncertainty(task, theta, &at, &rivals, (reduced, freedom)),
        reduced_chi_square: reduced,
        matches: matches(task, &kinds, &values),
        agreeing_starts: agreeing as f64 / runs.len() as f64,
        pulls: pulls(task, theta, &at.normal),
        values,
    })
}

fn check(task: &Tuning) -> Outcome<()> {
    let wrong = |p: &&Parameter| !(p.bounds[0] > 0.0 && p.bounds[0] < p.bounds[1] && p.start > 0.0);
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

fn singular() -> Problem {
    Problem::new(
        "the model has no finite FRF at these values",
        "check masses and stiffnesses of the robot file: each coordinate needs both",
    )
}

fn pairs(task: &Tuning) -> impl Iterator<Item = (&Pose, &Measured)> {
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
fn freedom(task: &Tuning) -> f64 {
    let of = |pair: &Measured| {
        2.0 * pair.frf.len() as f64 / pair.lines_per_independent_one()
            - task.residuals.terms() as f64
    };
    let measured: f64 = pairs(task).map(|(_, pair)| of(pair)).sum();
    let fitted = task.parameters.iter().filter(|p| !p.nuisance).count();
    (measured - fitted as f64).max(1.0)
}

/// Levenberg-Marquardt, steps cut at the bounds.
fn descend(task: &Tuning, kinds: &[Kind], mut theta: Vec<f64>) -> Option<(Vec<f64>, f64)> {
    let mut at = linearise(task, kinds, &theta)?;
    let mut brake = 1e-3;
    for _ in 0..60 {
        let before = at.cost;
        while brake < 1e10 {
            let trial = stepped(task, &theta, &at, brake);
            let found = trial.and_then(|trial| Some((linearise(task, kinds, &trial)?, trial)));
            if let Some((lower, trial)) = found.filter(|(found, _)| found.cost < at.cost) {
                (at, theta) = (lower, trial);
                brake = (0.1 * brake).max(1e-10);
                break;
            }
            brake *= 10.0;
        }
        if before - at.cost <= 1e-9 * before {
            break;
        }
    }
    Some((theta, at.cost))
}

/// A damped step; parameters that push against a bound stay there.
fn stepped(task: &Tuning, theta: &[f64], at: &Linearised, brake: f64) -> Option<Vec<f64>> {
    let bound = |i: usize, side: usize| task.parameters[i].bounds[side].ln();
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

/// `JᵀJ`, `−Jᵀr` and cost at the logarithms `theta`, priors included.
pub(super) fn linearise(task: &Tuning, kinds: &[Kind], theta: &[f64]) -> Option<Linearised> {
    let values: Vec<f64> = theta.iter().map(|t| t.exp()).collect();
    let n = theta.len();
    let mut sum = Linearised {
        normal: DMatrix::zeros(n, n),
        slope: DVector::zeros(n),
        cost: 0.0,
    };
    for pose in &task.poses {
        let entries = pose.entries();
        for pairs in pose.measured.chunk_by(Measured::on_lines_of) {
            let responses = pose.responses(kinds, &values, &pairs[0])?;
            let weighed = pose.weighed(&responses, &pairs[0]);
            for pair in pairs {
                let (frf, slopes) =
                    pose.sensitivities_of(&responses, &weighed, kinds, &entries, pair);
                sum.add(&channel(pair, &frf, &slopes, &values, task.residuals));
            }
        }
    }
    for (i, parameter) in task.parameters.iter().enumerate() {
        if let Some(deviation) = parameter.prior_ln_std {
            let off = (theta[i] - parameter.start.ln()) / deviation;
            sum.normal[(i, i)] += deviation.powi(-2);
            sum.slope[i] -= off / deviation;
            sum.cost += off * off;
        }
    }
    sum.cost.is_finite().then_some(sum)
}

impl Linearised {
    fn add(&mut self, (jacobian, rest): &(DMatrix<f64>, DVector<f64>)) {
        self.normal += jacobian.tr_mul(jacobian);
        self.slope += jacobian.tr_mul(rest);
        self.cost += rest.norm_squared();
    }
}

/// Weighted `∂H/∂lnθ` and `measured − simulated` of one channel, residual terms projected out.
fn channel(
    pair: &Measured,
    frf: &[Complex64],
    slopes: &[Vec<Complex64>],
    values: &[f64],
    residuals: Residuals,
) -> (DMatrix<f64>, DVector<f64>) {
    let independent = pair.lines_per_independent_one();
    let weight: Vec<f64> = pair
        .variance
        .iter()
        .map(|v| (2.0 / (v * independent)).sqrt())
        .collect();
    let rest: Vec<Complex64> = pair.frf.iter().zip(frf).map(|(m, a)| m - a).collect();
    let mut rest = DVector::from_vec(stacked(&rest, &weight));
    let columns = slopes.iter().zip(values).flat_map(|(slope, value)| {
        let scaled: Vec<Complex64> = slope.iter().map(|v| v * *value).collect();
        stacked(&scaled, &weight)
    });
    let mut jacobian = DMatrix::from_vec(rest.len(), slopes.len(), columns.collect());
    if let Some(q) = residual_basis(pair, &weight, residuals) {
        rest -= &q * q.tr_mul(&rest);
        jacobian -= &q * q.tr_mul(&jacobian);
    }
    (jacobian, rest)
}

fn stacked(column: &[Complex64], weight: &[f64]) -> Vec<f64> {
    crate::signal::modal_model::stacked(column, weight)
}

fn matches(task: &Tuning, kinds: &[Kind], values: &[f64]) -> Vec<Vec<[FrfMatch; 2]>> {
    let starts: Vec<f64> = task.parameters.iter().map(|p| p.start).collect();
    let of = |pose: &Pose, pair: &Measured, theta: &[f64]| {
        let simulated = pose.accelerance(kinds, theta, pair).unwrap_or_default();
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
