//! What measured FRFs say about each constant, and which combinations they fix.

use super::frf_tuning::{Linearised, Tuning};
use crate::signal::jackknife::t95;
use nalgebra::{DMatrix, DVector, SymmetricEigen};

/// Standard deviation of a logarithm above which a constant is not identifiable: a factor of 2 either
/// way at 95 %.
const IDENTIFIABLE: f64 = 0.35;
/// Standard deviation of the logarithm of a combination that the data fix.
const FIXED: f64 = 0.1;
/// Relative standard deviation that no calibration of hammer and sensors is better than. It is the same
/// on all lines, so that no number of lines averages it out.
const CALIBRATION: f64 = 0.001;
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
    /// Covariance of the logarithms (n × n), nuisances left out.
    pub ln_covariance: DMatrix<f64>,
    /// Combinations that the data fix, the best first.
    pub fixed: Vec<Combination>,
}

/// Reads the uncertainty off the normal matrix, nuisances marginalised, scaled up where the fit is
/// worse than the noise, and widened to `rivals`: other minima that explain the data as well.
pub(super) fn uncertainty(
    task: &Tuning,
    theta: &[f64],
    at: &Linearised,
    rivals: &[&[f64]],
    (reduced_chi_square, freedom): (f64, f64),
) -> Uncertainty {
    let scale = reduced_chi_square.max(1.0);
    let normal = marginal(task, &at.normal);
    let asked_for = &task.parameters[..normal.nrows()];
    let mut data = normal.clone();
    for (i, parameter) in asked_for.iter().enumerate() {
        data[(i, i)] -= parameter
            .prior_ln_std
            .map_or(0.0, |deviation| deviation.powi(-2));
    }
    let covariance = inverse(&normal) * scale;
    let data_only = inverse(&data) * scale;
    let statement = |i: usize| {
        let apart = rivals.iter().map(|rival| (rival[i] - theta[i]).abs());
        let apart = apart.fold(0.0, f64::max) / t95(freedom);
        let deviation = calibrated(covariance[(i, i)]) + apart;
        let alone = calibrated(data_only[(i, i)]) + apart < IDENTIFIABLE;
        statement(task, theta, i, deviation, alone, freedom)
    };
    Uncertainty {
        statements: (0..asked_for.len()).map(statement).collect(),
        fixed: combinations(&data, scale, &data_only)
            .into_iter()
            .map(|one| one.holding(theta, rivals))
            .filter(|one| one.ln_std < FIXED)
            .collect(),
        ln_covariance: covariance,
    }
}

/// What the data say about all but the nuisances, whose priors they share: the Schur complement of the
/// block of the nuisances.
fn marginal(task: &Tuning, normal: &DMatrix<f64>) -> DMatrix<f64> {
    let kept = task.parameters.iter().filter(|p| !p.nuisance).count();
    let along = normal.nrows() - kept;
    let mut rest = normal.view((0, 0), (kept, kept)).into_owned();
    let shared = normal.view((kept, 0), (along, kept)).into_owned();
    let block = normal.view((kept, kept), (along, along)).into_owned();
    if let Some(block) = block.cholesky().filter(|_| along > 0) {
        rest -= shared.tr_mul(&block.solve(&shared));
    }
    rest
}

/// Standard deviation from the variance of a logarithm, what calibrations leave included.
fn calibrated(variance: f64) -> f64 {
    variance.sqrt().hypot(CALIBRATION)
}

/// Inverse of a semidefinite matrix; directions without information get a deviation of 1000.
fn inverse(normal: &DMatrix<f64>) -> DMatrix<f64> {
    let eigen = SymmetricEigen::new(normal.clone());
    let inverted = eigen.eigenvalues.map(|value| 1.0 / value.max(1e-6));
    &eigen.eigenvectors * DMatrix::from_diagonal(&inverted) * eigen.eigenvectors.transpose()
}

fn statement(
    task: &Tuning,
    theta: &[f64],
    i: usize,
    deviation: f64,
    alone: bool,
    freedom: f64,
) -> Statement {
    let at_bound = task.parameters[i]
        .bounds
        .iter()
        .any(|b| (theta[i] - b.ln()).abs() < 1e-9);
    let status = match (at_bound, deviation < IDENTIFIABLE) {
        (true, _) => Status::AtBound,
        (false, true) => Status::Identified,
        (false, false) => Status::NotIdentifiable,
    };
    let known = status == Status::Identified;
    let half = t95(freedom) * deviation;
    Statement {
        status,
        stderr: known.then(|| theta[i].exp() * deviation),
        ci95: known.then(|| [(theta[i] - half).exp(), (theta[i] + half).exp()]),
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
