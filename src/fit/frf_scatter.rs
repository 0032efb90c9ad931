//! How far tuned constants scatter: the covariance of the slopes of the cost, from the noise that a
//! window correlates over lines, and from the hits.
//!
//! Weights that are not the inverse covariance of the data give estimates of covariance `A⁻¹BA⁻¹`
//! (White 1982), A the normal matrix and B the covariance of the slopes.

use super::frf_data::Measured;
use super::frf_linear::{Channel, channels};
use super::frf_tuning::Tuning;
use super::parameter::Z95;
use crate::ground::products::gram;
use crate::signal::jackknife::{covariance, t95};
use crate::signal::line_noise::LineNoise;
use nalgebra::{DMatrix, DVector};
use rustfft::num_complex::Complex64;

/// Covariances of the slopes.
pub(super) struct Scatter {
    /// By the noise of single lines under the window, and by errors of the force that lines share.
    lines: DMatrix<f64>,
    /// By the scatter of the hits, as the jackknife over each direction sees it; zero where every direction has one hit.
    hits: DMatrix<f64>,
    /// Degrees of freedom of the second.
    freedom: usize,
}

/// The covariance of the slopes at the logarithms `theta`; none where the model has no finite FRF.
pub(super) fn scatter(task: &Tuning, theta: &[f64]) -> Option<Scatter> {
    let n = theta.len();
    let mut sum = Scatter {
        lines: DMatrix::zeros(n, n),
        hits: DMatrix::zeros(n, n),
        freedom: 0,
    };
    for pose in channels(task, theta, n)? {
        for direction in pose.chunk_by(|a, b| a.pair.input == b.pair.input) {
            for channel in direction {
                sum.lines += under_window(channel.pair, &channel.jacobian);
            }
            sum.add_shared(direction);
            sum.add_hits(direction);
        }
    }
    Some(sum)
}

impl Scatter {
    /// `A⁻¹BA⁻¹` from `A⁻¹`: the larger of the two scatters, that of the hits with its Student factor.
    /// `rest` is the variance of what the fit leaves in units of the noise; `priors`, on the diagonal,
    /// are measurements like others.
    pub(super) fn covariance(
        &self,
        inverse: &DMatrix<f64>,
        rest: f64,
        priors: &DMatrix<f64>,
    ) -> DMatrix<f64> {
        let mut covariance = inverse * (&self.lines * rest + priors) * inverse;
        if self.freedom == 0 {
            return covariance;
        }
        let few = (t95(self.freedom as f64) / Z95).powi(2);
        let hits = inverse * (&self.hits + priors) * inverse * few;
        for i in 0..covariance.nrows() {
            let by = (hits[(i, i)] / covariance[(i, i)]).max(1.0).sqrt();
            covariance.row_mut(i).scale_mut(by);
            covariance.column_mut(i).scale_mut(by);
        }
        covariance
    }

    /// Adds the errors of the force that the channels of one direction and their lines share.
    fn add_shared(&mut self, direction: &[Channel]) {
        for error in 0..direction[0].pair.errors.shared.len() {
            let slope = |channel: &Channel| {
                let moved = &channel.pair.errors.shared[error];
                channel.jacobian.tr_mul(&channel.pair.weighted_error(moved))
            };
            let slope = direction.iter().map(slope).sum::<DVector<f64>>();
            self.lines.ger(1.0, &slope, &slope, 1.0);
        }
    }

    /// Adds the jackknife of one direction.
    fn add_hits(&mut self, direction: &[Channel]) {
        let hits = direction[0].pair.errors.left_out.len();
        if hits < 2 {
            return;
        }
        let slope = |hit: usize| {
            let of = |channel: &Channel| {
                let left_out = &channel.pair.errors.left_out[hit];
                let moved = channel.pair.weighted_change(left_out);
                channel.jacobian.tr_mul(&moved)
            };
            direction.iter().map(of).sum::<DVector<f64>>()
        };
        let slopes: Vec<DVector<f64>> = (0..hits).map(slope).collect();
        self.hits += covariance(&slopes);
        self.freedom += hits - 1;
    }
}

/// `Re(GᴴRG)` with R the correlation of the lines, over the number of lines that carry the information
/// of one, as the weights count it.
fn under_window(pair: &Measured, jacobian: &DMatrix<f64>) -> DMatrix<f64> {
    let lines = pair.frf.len();
    let independent = pair.lines_per_independent_one();
    if independent <= 1.0 {
        return gram(jacobian);
    }
    let noise = LineNoise::new(
        lines,
        pair.rate * pair.length_s,
        pair.errors.impulse_s / pair.length_s,
    );
    let mut through = DMatrix::zeros(jacobian.nrows(), jacobian.ncols());
    for (mut out, column) in through.column_iter_mut().zip(jacobian.column_iter()) {
        let values = (0..lines).map(|k| Complex64::new(column[k], column[lines + k]));
        for (k, value) in noise.times(values).into_iter().enumerate() {
            (out[k], out[lines + k]) = (value.re, value.im);
        }
    }
    jacobian.tr_mul(&through) / independent
}
