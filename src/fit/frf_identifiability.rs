//! What measured FRFs say about each constant, and which combinations they fix.

use super::frf_data::Errors;
use super::frf_linear::{Frozen, Linearised};
use super::frf_profile::widened;
use super::frf_scatter::{Scatter, scatter};
use super::frf_tuning::{Parameter, Tuning};
use crate::signal::jackknife::t95;
use nalgebra::{DMatrix, DVector, SymmetricEigen};
use rayon::prelude::*;

/// Relative standard deviation above which a constant is not identifiable.
const IDENTIFIABLE: f64 = 0.35;
/// Standard deviation of the logarithm of a combination that the data fix.
const FIXED: f64 = 0.1;
/// Relative standard deviation that no calibration of hammer and sensors is better than. It is the same
/// on all lines, so that no number of lines averages it out.
const CALIBRATION: f64 = 0.001;
/// Relative standard deviation by curvature up to which it is worth following the profile.
const WORTH: f64 = 1.0;
/// Share of its first guess at which the slope of a constant is taken at least.
const LEAST: f64 = 0.03;
/// Information that is none: a deviation of 1000.
const NOTHING: f64 = 1e-6;
/// Exponents below which a factor is left out of a combination, as long as it stays fixed without.
const SMALL: [f64; 4] = [0.1, 0.03, 0.01, 0.0];

/// What became of a parameter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Status {
    /// The data (with the stated priors) fix it.
    Identified,
    /// It lies at a bound.
    AtBound,
    /// The data say nothing useful about it alone.
    NotIdentifiable,
}

/// What the data say about one parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct Statement {
    /// Its status.
    pub status: Status,
    /// Standard error, SI; none unless identified.
    pub stderr: Option<f64>,
    /// 95 % interval, SI; none unless identified.
    pub ci95: Option<[f64; 2]>,
    /// Whether it would not be identifiable without its prior.
    pub by_prior: bool,
}

/// A product of powers `Π θᵢ^wᵢ` that the data fix.
#[derive(Debug, Clone, PartialEq)]
pub struct Combination {
    /// Exponents by index of the parameter, the large ones.
    pub weights: Vec<(usize, f64)>,
    /// Standard deviation of its logarithm.
    pub ln_std: f64,
}

impl Combination {
    /// The same with a deviation that holds what `rivals` say of it.
    fn holding(self, theta: &[f64], rivals: &[&[f64]]) -> Self {
        let apart = |rival: &&[f64]| -> f64 {
            let parts = self.weights.iter();
            parts.map(|(i, w)| w * (rival[*i] - theta[*i])).sum()
        };
        let furthest = rivals.iter().map(|r| apart(r).abs()).fold(0.0, f64::max);
        Self {
            ln_std: self.ln_std + furthest / 1.96,
            weights: self.weights,
        }
    }
}

/// What the data say about all parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct Uncertainty {
    /// Per parameter.
    pub statements: Vec<Statement>,
    /// Relative covariance (n × n), nuisances left out.
    pub covariance: DMatrix<f64>,
    /// Combinations that the data fix, the best first.
    pub fixed: Vec<Combination>,
}

/// A place in a task.
#[derive(Clone, Copy)]
pub(super) struct Place<'a> {
    /// The task.
    pub(super) task: &'a Tuning,
    /// Logarithms of the parameters.
    pub(super) theta: &'a [f64],
    /// The normal equations there.
    pub(super) at: &'a Linearised,
}

/// Reads the uncertainty off the best place, nuisances marginalised, scaled up where the fit is worse
/// than the noise, and widened to `rivals`: other minima that explain the data as well.
pub(super) fn uncertainty(
    best: Place,
    rivals: &[&[f64]],
    (reduced_chi_square, freedom): (f64, f64),
) -> Uncertainty {
    let (task, theta) = (best.task, best.theta);
    let rest = reduced_chi_square.max(1.0);
    let asked_for = task.asked_for();
    let found = scatter(task, theta);
    let spread = |priors_of: usize| spread(best, found.as_ref(), rest, priors_of);
    let (all, data_only) = (spread(0), spread(asked_for));
    let inverse = inverse(&best.at.normal);
    let bare = bare(task);
    let frozen = Frozen::at(&bare, theta);
    let bare = Place {
        task: &bare,
        ..best
    };
    let statement = |i: usize| {
        let apart = |rival: &&[f64]| (rival[i] - theta[i]).exp_m1().abs();
        let apart = rivals.iter().map(apart).fold(0.0, f64::max) / t95(freedom);
        let deviation = calibrated(all[(i, i)]) + apart;
        let sides = match &frozen {
            Some(frozen) if deviation < WORTH => {
                widened(bare, (&inverse, frozen), i, t95(freedom) * deviation)
            }
            _ => [None; 2],
        };
        let alone = calibrated(data_only[(i, i)]) + apart < IDENTIFIABLE;
        statement(best, i, sides, alone, freedom)
    };
    let data = marginal(&without_priors(best, asked_for), asked_for);
    let fixed = combinations(&data, rest, &kept(&data_only, asked_for)).into_iter();
    Uncertainty {
        statements: (0..asked_for).into_par_iter().map(statement).collect(),
        fixed: fixed
            .map(|one| one.holding(theta, rivals))
            .filter(|one| one.ln_std < FIXED)
            .collect(),
        covariance: kept(&all, asked_for),
    }
}

/// The task without the errors of its data, which a search does not need: a profile copies it often.
fn bare(task: &Tuning) -> Tuning {
    let mut bare = task.clone();
    let pairs = bare.poses.iter_mut().flat_map(|pose| &mut pose.measured);
    pairs.for_each(|pair| pair.errors = Errors::default());
    bare
}

/// Relative covariance of all parameters, the priors of the first `ignored` left out.
fn spread(best: Place, scatter: Option<&Scatter>, rest: f64, ignored: usize) -> DMatrix<f64> {
    let raised = raised(&best.task.parameters, best.theta);
    let inverse = inverse_of(&without_priors(best, ignored), &raised);
    let prior = |(i, p): (usize, &Parameter)| {
        let own = p.prior_ln_std.filter(|_| i >= ignored);
        own.map_or(0.0, |deviation| deviation.powi(-2)) + NOTHING / raised[i].powi(2)
    };
    let priors = best.task.parameters.iter().enumerate().map(prior);
    let priors = DVector::from_iterator(best.theta.len(), priors);
    match scatter {
        Some(found) => found.covariance(&inverse, rest, &DMatrix::from_diagonal(&priors)),
        None => inverse * rest,
    }
}

/// The normal matrix without the priors of the first `ignored` parameters.
fn without_priors(best: Place, ignored: usize) -> DMatrix<f64> {
    let mut normal = best.at.normal.clone();
    for (i, parameter) in best.task.parameters[..ignored].iter().enumerate() {
        normal[(i, i)] -= parameter.prior_ln_std.map_or(0.0, |d| d.powi(-2));
    }
    normal
}

/// The block of the first `count` parameters.
fn kept(matrix: &DMatrix<f64>, count: usize) -> DMatrix<f64> {
    matrix.view((0, 0), (count, count)).into_owned()
}

/// Per parameter the value at which its slope is taken for the uncertainty, over the fitted one. The
/// FRFs depend on dampings nearly linearly, on their logarithms not: a damping that the fit drives to
/// nothing moves the others all the same.
fn raised(parameters: &[Parameter], theta: &[f64]) -> Vec<f64> {
    let least = |parameter: &Parameter| LEAST * parameter.start;
    let all = parameters.iter().zip(theta);
    all.map(|(parameter, theta)| match parameter.kind.is_signed() {
        true => 1.0,
        false => (least(parameter) / theta.exp()).max(1.0),
    })
    .collect()
}

/// The relative covariance from a normal matrix of logarithms.
fn inverse_of(normal: &DMatrix<f64>, raised: &[f64]) -> DMatrix<f64> {
    let by = |m: &DMatrix<f64>| {
        let raise = |i: usize, j: usize| m[(i, j)] * raised[i] * raised[j];
        DMatrix::from_fn(m.nrows(), m.ncols(), raise)
    };
    by(&inverse(&by(normal)))
}

/// What the data say about the first `count` parameters, whatever the others are: the Schur complement
/// of the block of the others.
fn marginal(normal: &DMatrix<f64>, count: usize) -> DMatrix<f64> {
    let along = normal.nrows() - count;
    let shared = normal.view((count, 0), (along, count)).into_owned();
    let block = normal.view((count, count), (along, along)).into_owned();
    let rest = kept(normal, count);
    match block.cholesky().filter(|_| along > 0) {
        Some(block) => rest - shared.tr_mul(&block.solve(&shared)),
        None => rest,
    }
}

/// Standard deviation from the variance of a logarithm, what calibrations leave included.
fn calibrated(variance: f64) -> f64 {
    variance.sqrt().hypot(CALIBRATION)
}

/// Inverse of a semidefinite matrix; directions without information get that of [`NOTHING`].
pub(super) fn inverse(normal: &DMatrix<f64>) -> DMatrix<f64> {
    let eigen = SymmetricEigen::new(normal.clone());
    let inverted = eigen.eigenvalues.map(|value| 1.0 / value.max(NOTHING));
    &eigen.eigenvectors * DMatrix::from_diagonal(&inverted) * eigen.eigenvectors.transpose()
}

fn statement(
    best: Place,
    i: usize,
    sides: [Option<f64>; 2],
    alone: bool,
    freedom: f64,
) -> Statement {
    let theta = best.theta[i];
    let bounds = best.task.parameters[i].bounds;
    let at_bound = bounds.iter().any(|b| (theta - b.ln()).abs() < 1e-9);
    let deviation = match sides {
        [Some(below), Some(above)] if below < 1.0 => (below + above) / (2.0 * t95(freedom)),
        _ => f64::INFINITY,
    };
    let status = match (at_bound, deviation < IDENTIFIABLE) {
        (true, _) => Status::AtBound,
        (false, true) => Status::Identified,
        (false, false) => Status::NotIdentifiable,
    };
    let known = status == Status::Identified;
    let value = theta.exp();
    let ends = || Some([(1.0 - sides[0]?) * value, (1.0 + sides[1]?) * value]);
    Statement {
        status,
        stderr: known.then_some(value * deviation),
        ci95: ends().filter(|_| known),
        by_prior: known && !alone,
    }
}

fn combinations(data: &DMatrix<f64>, scale: f64, covariance: &DMatrix<f64>) -> Vec<Combination> {
    let eigen = SymmetricEigen::new(data.clone());
    let columns = eigen
        .eigenvalues
        .iter()
        .zip(eigen.eigenvectors.column_iter());
    let informed = columns.filter(|(value, _)| **value > scale / (FIXED * FIXED));
    let mut fixed: Vec<Combination> = informed
        .filter_map(|(_, vector)| shortened(&vector.into_owned(), covariance))
        .collect();
    fixed.sort_by(|a, b| a.ln_std.total_cmp(&b.ln_std));
    fixed
}

/// The combination `vector` with as few factors as are still fixed: a small power of a constant that
/// nothing fixes may spoil it.
fn shortened(vector: &DVector<f64>, covariance: &DMatrix<f64>) -> Option<Combination> {
    let without = |least: f64| {
        let large = vector.map(|w| if w.abs() > least { w } else { 0.0 });
        let ln_std = calibrated(large.dot(&(covariance * &large)));
        let weights = large.iter().copied().enumerate();
        Combination {
            weights: weights.filter(|(_, w)| *w != 0.0).collect(),
            ln_std,
        }
    };
    SMALL
        .into_iter()
        .map(without)
        .find(|one| one.ln_std < FIXED)
}
