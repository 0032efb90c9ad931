//! Residuals of a tuning task and their derivatives at one place: weighted, in the logarithms of the
//! parameters, the terms of what the model leaves out projected away.

use super::frf_data::Measured;
use super::frf_model::Pose;
use super::frf_residuals::{Residuals, residual_basis};
use super::frf_tuning::Tuning;
use crate::signal::modal_model::stacked;
use nalgebra::{DMatrix, DVector};
use rustfft::num_complex::Complex64;

/// The normal equations at one place.
pub(super) struct Linearised {
    /// `JᵀJ`.
    pub(super) normal: DMatrix<f64>,
    /// `−Jᵀr`.
    pub(super) slope: DVector<f64>,
    /// `rᵀr`.
    pub(super) cost: f64,
}

/// What one channel says at one place.
pub(super) struct Channel<'a> {
    /// What was measured.
    pub(super) pair: &'a Measured,
    /// Weighted `∂H/∂lnθ`, residual terms projected out.
    pub(super) jacobian: DMatrix<f64>,
    /// Weighted `measured − simulated`.
    rest: DVector<f64>,
}

/// All channels at the logarithms `theta`, per pose and in their order.
pub(super) fn channels<'a>(task: &'a Tuning, theta: &[f64]) -> Option<Vec<Vec<Channel<'a>>>> {
    let kinds = &task.kinds();
    let values: Vec<f64> = theta.iter().map(|t| t.exp()).collect();
    let of = |pose: &'a Pose| {
        let entries = pose.entries();
        let mut all = Vec::new();
        for pairs in pose.measured.chunk_by(Measured::on_lines_of) {
            let responses = pose.responses(kinds, &values, &pairs[0])?;
            let weighed = pose.weighed(&responses, &pairs[0]);
            all.extend(pairs.iter().map(|pair| {
                let (frf, slopes) =
                    pose.sensitivities_of(&responses, &weighed, kinds, &entries, pair);
                channel(pair, &frf, &slopes, &values, task.residuals)
            }));
        }
        Some(all)
    };
    task.poses.iter().map(of).collect()
}

/// The normal equations at the logarithms `theta`, priors included.
pub(super) fn linearise(task: &Tuning, theta: &[f64]) -> Option<Linearised> {
    let n = theta.len();
    let mut sum = Linearised {
        normal: DMatrix::zeros(n, n),
        slope: DVector::zeros(n),
        cost: 0.0,
    };
    for channel in channels(task, theta)?.iter().flatten() {
        sum.add(channel);
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
    fn add(&mut self, Channel { jacobian, rest, .. }: &Channel) {
        self.normal += jacobian.tr_mul(jacobian);
        self.slope += jacobian.tr_mul(rest);
        self.cost += rest.norm_squared();
    }
}

/// One channel from its FRF and the slopes of that in the values.
fn channel<'a>(
    pair: &'a Measured,
    frf: &[Complex64],
    slopes: &[Vec<Complex64>],
    values: &[f64],
    residuals: Residuals,
) -> Channel<'a> {
    let weight = pair.weight();
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
    Channel {
        pair,
        jacobian,
        rest,
    }
}
