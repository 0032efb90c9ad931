//! Terms for what a model leaves out of an FRF: modes above the band, motion below it.

use super::frf_data::Measured;
use crate::signal::modal_model::stacked;
use nalgebra::{DMatrix, DVector};
use rustfft::num_complex::Complex64;

/// Which terms stand for what the model leaves out, with a real factor per channel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Residuals {
    /// None.
    None,
    /// `s²/K`: stiffness of the modes above the band.
    #[default]
    Upper,
    /// `s²/K` and `1/M`.
    Both,
}

impl Residuals {
    /// How many terms each channel has.
    pub(super) fn terms(self) -> usize {
        self.powers().len()
    }

    fn powers(self) -> &'static [i32] {
        match self {
            Self::None => &[],
            Self::Upper => &[2],
            Self::Both => &[0, 2],
        }
    }
}

/// Orthonormal basis of the weighted terms of a channel; none without terms.
pub(super) fn residual_basis(
    pair: &Measured,
    weight: &[f64],
    residuals: Residuals,
) -> Option<DMatrix<f64>> {
    let powers = residuals.powers();
    if powers.is_empty() {
        return None;
    }
    let top = pair.s(pair.frf.len().checked_sub(1)?).norm();
    let column = |power: &i32| {
        let term: Vec<Complex64> = (0..pair.frf.len())
            .map(|k| (pair.s(k) / top).powi(*power))
            .collect();
        stacked(&term, weight)
    };
    let columns: Vec<f64> = powers.iter().flat_map(column).collect();
    Some(
        DMatrix::from_vec(2 * pair.frf.len(), powers.len(), columns)
            .qr()
            .q(),
    )
}

/// The simulated FRF with its residual terms, fitted to the measured one.
pub(super) fn with_residuals(
    residuals: Residuals,
    pair: &Measured,
    simulated: &[Complex64],
) -> Vec<Complex64> {
    let rest: Vec<Complex64> = pair.frf.iter().zip(simulated).map(|(m, a)| m - a).collect();
    let weight: Vec<f64> = pair.variance.iter().map(|v| v.sqrt().recip()).collect();
    let Some(q) = residual_basis(pair, &weight, residuals) else {
        return simulated.to_vec();
    };
    let rest = DVector::from_vec(stacked(&rest, &weight));
    let part = &q * q.tr_mul(&rest);
    let n = simulated.len();
    let term = |k: usize| Complex64::new(part[k], part[n + k]) / weight[k];
    simulated
        .iter()
        .enumerate()
        .map(|(k, h)| h + term(k))
        .collect()
}
