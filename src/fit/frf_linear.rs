//! Residuals of a tuning task and their derivatives at one place: weighted, in the logarithms of the
//! parameters, the terms of what the model leaves out projected away.

use super::frf_data::Measured;
use super::frf_model::Pose;
use super::frf_residuals::{Residuals, residual_basis};
use super::frf_tuning::Tuning;
use crate::ground::products::{gram, tr_mul};
use crate::motion::frf::Response;
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

/// The slopes of what is fitted along, as they are at one place: nuisances move the FRFs so little that
/// these hold all about it, and most of the work is theirs.
pub(super) struct Frozen {
    /// Where they were taken.
    theta: Vec<f64>,
    /// How many parameters are asked for.
    count: usize,
    /// Per channel, in their order.
    columns: Vec<DMatrix<f64>>,
    /// Their block of the normal matrix, without priors.
    block: DMatrix<f64>,
}

impl Frozen {
    /// At `theta`; none where the model has no finite FRF.
    pub(super) fn at(task: &Tuning, theta: &[f64]) -> Option<Self> {
        let count = task.asked_for();
        let along = theta.len() - count;
        let all = channels(task, theta, theta.len())?.into_iter().flatten();
        let columns: Vec<DMatrix<f64>> = all
            .map(|channel| channel.jacobian.columns(count, along).into_owned())
            .collect();
        let mut block = DMatrix::zeros(along, along);
        columns.iter().for_each(|c| block += gram(c));
        Some(Self {
            theta: theta.to_vec(),
            count,
            columns,
            block,
        })
    }

    /// The normal equations at `theta`, linear in what is fitted along.
    pub(super) fn linearise(&self, task: &Tuning, theta: &[f64]) -> Option<Linearised> {
        let (n, count) = (theta.len(), self.count);
        let place = [&theta[..count], &self.theta[count..]].concat();
        let moved = DVector::from_fn(n - count, |i, _| theta[count + i] - self.theta[count + i]);
        let mut sum = Linearised::nothing(n);
        let mut across = DMatrix::zeros(count, n - count);
        let all = channels(task, &place, count)?;
        for (channel, along) in all.iter().flatten().zip(&self.columns) {
            let (own, rest) = (&channel.jacobian, &channel.rest - along * &moved);
            let mut block = sum.normal.view_mut((0, 0), (count, count));
            block += gram(own);
            across += tr_mul(own, along);
            let mut slope = sum.slope.rows_mut(0, count);
            slope += own.tr_mul(&rest);
            let mut slope = sum.slope.rows_mut(count, n - count);
            slope += along.tr_mul(&rest);
            sum.cost += rest.norm_squared();
        }
        let mut put = |at: (usize, usize), block: &DMatrix<f64>| {
            sum.normal.view_mut(at, block.shape()).copy_from(block);
        };
        put((count, count), &self.block);
        put((0, count), &across);
        put((count, 0), &across.transpose());
        sum.with_priors(task, theta)
    }
}

/// All channels where the search is at `theta`, per pose and in their order, with slopes in the first
/// `count` parameters.
pub(super) fn channels<'a>(
    task: &'a Tuning,
    theta: &[f64],
    count: usize,
) -> Option<Vec<Vec<Channel<'a>>>> {
    let kinds = &task.kinds();
    let values = task.values(theta);
    let rates: Vec<f64> = (task.parameters.iter().zip(&values))
        .map(|(p, value)| p.rate(*value))
        .collect();
    let of =
        |pose: &'a Pose| {
            let entries = pose.entries();
            let mut all = Vec::new();
            for pairs in pose.measured.chunk_by(Measured::on_lines_of) {
                let responses = pose.responses(kinds, &values, &pairs[0])?;
                let slopes = pose.slopes(&responses, &kinds[..count], &entries);
                all.extend(pairs.iter().map(|pair| {
                    channel(pair, &responses.of(pair), (&slopes, &rates), task.residuals)
                }));
            }
            Some(all)
        };
    task.poses.iter().map(of).collect()
}

/// The normal equations at the logarithms `theta`, priors included.
pub(super) fn linearise(task: &Tuning, theta: &[f64]) -> Option<Linearised> {
    let mut sum = Linearised::nothing(theta.len());
    for channel in channels(task, theta, theta.len())?.iter().flatten() {
        sum.add(channel);
    }
    sum.with_priors(task, theta)
}

impl Linearised {
    fn nothing(n: usize) -> Self {
        Self {
            normal: DMatrix::zeros(n, n),
            slope: DVector::zeros(n),
            cost: 0.0,
        }
    }

    /// The same with the priors of the parameters; none where it is not finite.
    fn with_priors(mut self, task: &Tuning, theta: &[f64]) -> Option<Self> {
        for (i, parameter) in task.parameters.iter().enumerate() {
            if let Some(deviation) = parameter.prior_ln_std {
                let off = (theta[i] - parameter.coordinate(parameter.start)) / deviation;
                self.normal[(i, i)] += deviation.powi(-2);
                self.slope[i] -= off / deviation;
                self.cost += off * off;
            }
        }
        self.cost.is_finite().then_some(self)
    }

    fn add(&mut self, Channel { jacobian, rest, .. }: &Channel) {
        self.normal += gram(jacobian);
        self.slope += jacobian.tr_mul(rest);
        self.cost += rest.norm_squared();
    }
}

/// One channel from its FRF, the slopes of what is read in the values, and those of the values in what is
/// searched.
fn channel<'a>(
    pair: &'a Measured,
    frf: &[Complex64],
    (slopes, rates): (&[Vec<Response>], &[f64]),
    residuals: Residuals,
) -> Channel<'a> {
    let weight = pair.weight();
    let rest: Vec<Complex64> = pair.frf.iter().zip(frf).map(|(m, a)| m - a).collect();
    let mut rest = DVector::from_vec(stacked(&rest, &weight));
    let lines = pair.frf.len();
    let mut jacobian = DMatrix::zeros(rest.len(), slopes.len());
    for ((mut column, slope), rate) in jacobian.column_iter_mut().zip(slopes).zip(rates) {
        for (k, (line, weight)) in slope.iter().zip(&weight).enumerate() {
            let moved = line[pair.output][pair.input] * (rate * weight);
            column[k] = moved.re;
            column[lines + k] = moved.im;
        }
    }
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
