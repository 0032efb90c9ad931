//! Tunes dampings (and released stiffnesses and masses) until simulated FRFs meet measured ones:
//! least squares on the complex accelerance weighted with its variance. Parameters are logarithms
//! within bounds; residual terms of what the model leaves out are eliminated per channel.

use super::frf_data::Measured;
use super::frf_identifiability::{Place, Uncertainty, inverse, uncertainty};
use super::frf_linear::{Linearised, linearise};
use super::frf_match::{FrfMatch, frf_match};
use super::frf_model::{Kind, Pose};
use super::frf_nuisance::{Pull, pulls};
pub use super::frf_parameter::Parameter;
pub use super::frf_residuals::Residuals;
use super::frf_residuals::with_residuals;
use super::frf_rivals::rivals;
use super::frf_search::{Run, Stop, descend};
use super::frf_starts::{starts, thinned};
use crate::ground::problem::{Outcome, Problem};
use rayon::prelude::*;

/// Weighted sum of squares within which another minimum explains the data as well as the best: four
/// standard deviations. Springs in series about nearly the same axis have two solutions for their
/// dampings, which only the third order in frequency tells apart.
const RIVAL: f64 = 16.0;

/// The search from each start.
const SEARCH: Stop = Stop {
    steps: 200,
    gain: 1e-4,
};
/// Lines per pair on which is searched first.
const LINES: usize = 64;
/// At most so many places of that search are followed on all lines: those that are further apart in some
/// logarithm than this.
const PLACES: usize = 4;
const APART: f64 = 0.05;
/// How often a better solution found by exchanging dampings is exchanged in turn.
const EXCHANGES: usize = 3;
/// Gain in cost from which on a solution is a better one.
const ENOUGH: f64 = 0.1;

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

/// A task solved: where its descents ended.
pub(super) struct Solved {
    runs: Vec<Run>,
    agreeing_starts: f64,
    /// The normal equations at the best place.
    at: Linearised,
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

/// Descends from all starts, then from where dampings are exchanged, on some of the lines; then on all from
/// where that ended well.
pub(super) fn solve(task: &Tuning) -> Outcome<Solved> {
    check(task)?;
    let thin = thinned(task, LINES);
    let mut runs = descents(&thin, starts(task));
    let agreeing_starts = agreeing(&runs);
    let mut at = at_best(&thin, &mut runs)?;
    for _ in 0..EXCHANGES {
        let cost = at.cost;
        let near = rivals(task, &runs[0].0, &inverse(&at.normal));
        runs.extend(descents(&thin, near));
        at = at_best(&thin, &mut runs)?;
        if at.cost > cost - ENOUGH {
            break;
        }
    }
    let mut runs = descents(task, distinct(task, runs));
    let at = at_best(task, &mut runs)?;
    Ok(Solved {
        runs,
        agreeing_starts,
        at,
    })
}

/// The places of the best runs (sorted) that differ in what is asked for.
fn distinct(task: &Tuning, runs: Vec<Run>) -> Vec<Vec<f64>> {
    let count = task.asked_for();
    let apart = |a: &[f64], b: &[f64]| {
        let each = a[..count].iter().zip(&b[..count]);
        each.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    };
    let enough = runs.first().map_or(0.0, |best| 1.5 * best.1 + RIVAL);
    let mut kept: Vec<Vec<f64>> = Vec::new();
    for (theta, _) in runs.into_iter().filter(|run| run.1 <= enough) {
        if kept.len() < PLACES && kept.iter().all(|other| apart(&theta, other) > APART) {
            kept.push(theta);
        }
    }
    kept
}

/// Where searches from `starts` end.
fn descents(task: &Tuning, starts: Vec<Vec<f64>>) -> Vec<Run> {
    let runs = starts
        .into_par_iter()
        .map(|start| descend(task, start, SEARCH));
    runs.collect::<Vec<_>>().into_iter().flatten().collect()
}

/// Sorts the runs, the best first, and linearises there.
fn at_best(task: &Tuning, runs: &mut [Run]) -> Outcome<Linearised> {
    runs.sort_by(|a, b| a.1.total_cmp(&b.1));
    let best = runs.first();
    best.and_then(|run| linearise(task, &run.0))
        .ok_or_else(singular)
}

/// Share of the runs that reached the best cost (within 1 %).
fn agreeing(runs: &[Run]) -> f64 {
    let lowest = runs.iter().map(|run| run.1).fold(f64::INFINITY, f64::min);
    let near = |run: &&Run| run.1 <= 1.01 * lowest + 1e-12;
    runs.iter().filter(near).count() as f64 / runs.len().max(1) as f64
}

impl Solved {
    /// Logarithms of the best solution.
    fn theta(&self) -> &[f64] {
        &self.runs[0].0
    }

    /// Whether the model is further from the FRFs than one that never moves: no prior mends that.
    pub(super) fn worse_than_nothing(&self, task: &Tuning) -> bool {
        let size = |pair: &Measured| {
            let each = pair.frf.iter().zip(pair.weight());
            each.map(|(h, w)| (h * w).norm_sqr()).sum::<f64>()
        };
        self.at.cost > pairs(task).map(|(_, pair)| size(pair)).sum()
    }

    /// Where the nuisances went.
    pub(super) fn pulls(&self, task: &Tuning) -> Vec<Pull> {
        pulls(task, self.theta(), &self.at.normal)
    }

    /// What the solution says.
    pub(super) fn told(&self, task: &Tuning) -> Tuned {
        let freedom = freedom(task);
        let reduced = self.at.cost / freedom;
        let near = |run: &&Run| run.1 <= self.at.cost + RIVAL * reduced.max(1.0);
        let rivals: Vec<&[f64]> = self.runs.iter().filter(near).map(|r| &r.0[..]).collect();
        let values = task.values(self.theta());
        let place = Place {
            task,
            theta: self.theta(),
            at: &self.at,
        };
        Tuned {
            uncertainty: uncertainty(place, &rivals, (reduced, freedom)),
            reduced_chi_square: reduced,
            matches: matches(task, &values),
            agreeing_starts: self.agreeing_starts,
            pulls: self.pulls(task),
            worse_than_nothing: self.worse_than_nothing(task),
            values,
        }
    }
}

fn check(task: &Tuning) -> Outcome<()> {
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
    (measured - task.asked_for() as f64).max(1.0)
}

fn matches(task: &Tuning, values: &[f64]) -> Vec<Vec<[FrfMatch; 2]>> {
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
