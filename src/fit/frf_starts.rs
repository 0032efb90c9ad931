//! Where the searches of a tuning begin: at the first guesses, and at what the simplex of Nelder and
//! Mead (1965, crate `argmin`) makes of values drawn about them. The simplex needs no derivatives and
//! sees the logarithms of amplitudes on a few lines: a wide valley, where least squares on the complex
//! FRF sees a narrow one beside every peak. Far from the truth that saves more iterations than it
//! costs; where the first guesses are right already it costs a tenth of a second.

use super::frf_data::{Errors, Measured};
use super::frf_model::{Kind, Pose};
use super::frf_tuning::{Parameter, Tuning};
use crate::ground::random::Random;
use argmin::core::{CostFunction, Error, Executor, State};
use argmin::solver::neldermead::NelderMead;
use rayon::prelude::*;

/// Spread of the drawn logarithms: a factor of 10 either way.
const SPREAD: f64 = 2.3;
/// Spread of a nuisance, in standard deviations of its prior: stiffnesses in series about nearly the
/// same axis have several solutions, and draws near the robot's values miss the best.
const FAR: f64 = 3.0;
/// Lines per pair that the simplex sees.
const LINES: usize = 24;
/// Iterations per parameter.
const ITERATIONS: u64 = 4;

/// Logarithms from which to search, the first at the first guesses.
pub(super) fn starts(task: &Tuning) -> Vec<Vec<f64>> {
    let mut random = Random::new(11);
    let own = |p: &Parameter| p.coordinate(p.start);
    let first: Vec<f64> = task.parameters.iter().map(own).collect();
    let mut draw = || -> Vec<f64> {
        let near = first.iter().zip(&task.parameters).map(|(x, p)| {
            let own = p.prior_ln_std.filter(|_| p.nuisance);
            let spread = own.map_or(SPREAD, |deviation| FAR * deviation);
            x + random.uniform(-spread, spread)
        });
        inside(task, &near.collect::<Vec<f64>>())
    };
    let others = task.starts.max(1) - 1;
    let corners = first.len() + 1;
    let simplices: Vec<Vec<Vec<f64>>> = (0..others)
        .map(|_| (0..corners).map(|_| draw()).collect())
        .collect();
    let thin = Thin {
        task,
        kinds: task.kinds(),
        poses: thinned(task, LINES).poses,
    };
    let proposed = simplices
        .into_par_iter()
        .map(|simplex| thin.best_of(simplex));
    std::iter::once(inside(task, &first))
        .chain(proposed.collect::<Vec<_>>())
        .collect()
}

fn inside(task: &Tuning, theta: &[f64]) -> Vec<f64> {
    let clamped = theta.iter().zip(&task.parameters);
    clamped
        .map(|(x, p)| x.clamp(p.ends()[0], p.ends()[1]))
        .collect()
}

/// The task with at most so many lines of each pair, from the lowest to the highest, and without the errors
/// of its data.
pub(super) fn thinned(task: &Tuning, lines: usize) -> Tuning {
    Tuning {
        parameters: task.parameters.clone(),
        poses: task.poses.iter().map(|pose| few(pose, lines)).collect(),
        ..*task
    }
}

fn few(pose: &Pose, lines: usize) -> Pose {
    let measured = pose.measured.iter().map(|pair| {
        let step = pair.frf.len().div_ceil(lines).max(1);
        Measured {
            frequency_hz: pair.frequency_hz.iter().copied().step_by(step).collect(),
            frf: pair.frf.iter().copied().step_by(step).collect(),
            variance: pair.variance.iter().copied().step_by(step).collect(),
            errors: Errors::default(),
            ..pair.clone()
        }
    });
    Pose {
        measured: measured.collect(),
        ..pose.clone()
    }
}

struct Thin<'a> {
    task: &'a Tuning,
    kinds: Vec<Kind>,
    poses: Vec<Pose>,
}

impl Thin<'_> {
    /// Where the simplex ends; its first corner if there is no finite FRF.
    fn best_of(&self, simplex: Vec<Vec<f64>>) -> Vec<f64> {
        let first = simplex.first().cloned().unwrap_or_default();
        let most = ITERATIONS * first.len() as u64;
        let run = Executor::new(self, NelderMead::new(simplex))
            .configure(|state| state.max_iters(most))
            .timer(false)
            .run();
        let best = run
            .ok()
            .and_then(|run| run.state().get_best_param().cloned());
        inside(self.task, &best.unwrap_or(first))
    }
}

impl CostFunction for &Thin<'_> {
    type Param = Vec<f64>;
    type Output = f64;

    /// Sum of the squared differences of the logarithms of the amplitudes.
    fn cost(&self, theta: &Vec<f64>) -> Result<f64, Error> {
        let values = self.task.values(&inside(self.task, theta));
        let poses = self.poses.iter();
        let sum: Option<f64> = poses.map(|pose| self.apart(pose, &values)).sum();
        Ok(sum.filter(|sum| sum.is_finite()).unwrap_or(f64::MAX))
    }
}

impl Thin<'_> {
    fn apart(&self, pose: &Pose, values: &[f64]) -> Option<f64> {
        let mut sum = 0.0;
        for pairs in pose.measured.chunk_by(Measured::on_lines_of) {
            let responses = pose.responses(&self.kinds, values, &pairs[0])?;
            for pair in pairs {
                let simulated = responses.of(pair);
                let ratios = simulated
                    .iter()
                    .zip(&pair.frf)
                    .map(|(a, m)| a.norm() / m.norm());
                sum += ratios.map(|ratio| ratio.ln().powi(2)).sum::<f64>();
            }
        }
        Some(sum)
    }
}
