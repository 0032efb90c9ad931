//! The evidence of a set of causes when the colour of the noise is not known either.
//!
//! A weak drift in white noise and nothing at all in pink noise look alike: only both together, cause
//! and colour, have a likelihood. Outside the span of the screen it is the same for all causes; inside
//! it is tempered, since nature does not follow our formulas exactly.

use super::ambiguity::temper;
use crate::fit::least_squares::Optimum;
use crate::fit::screen::Tint;
use crate::signal::colour::Colour;
use nalgebra::{DMatrix, DVector};

/// How the plausible colours weigh a fit.
pub struct Tints<'a> {
    /// The colour that the fits used.
    pub used: &'a Colour,
    /// The plausible colours.
    pub all: &'a [Tint],
    /// How much of the misfit counts under each.
    tempers: Vec<f64>,
}

impl<'a> Tints<'a> {
    /// `plain`: the spring alone, whose misfit says how much there is to explain.
    pub fn new(used: &'a Colour, all: &'a [Tint], plain: &Optimum) -> Self {
        let misfits = misfits(plain, used, all);
        let to_explain = misfits.iter().zip(all).map(|(m, t)| 0.5 * (m - t.outside));
        Self {
            tempers: to_explain.map(temper).collect(),
            used,
            all,
        }
    }

    /// Log likelihood of a fit under every colour, its parameters moved by one Gauss-Newton step.
    fn logs(&self, fit: &Optimum) -> Vec<f64> {
        let misfits = misfits(fit, self.used, self.all);
        let each = misfits.iter().zip(self.all).zip(&self.tempers);
        each.map(|((misfit, tint), temper)| {
            tint.likelihood - tint.size - 0.5 * temper * (misfit - tint.outside)
        })
        .collect()
    }

    /// Log likelihood of a fit, summed over the colours.
    pub fn evidence(&self, fit: &Optimum) -> f64 {
        let logs = self.logs(fit);
        let top = logs.iter().copied().fold(f64::MIN, f64::max);
        top + logs.iter().map(|v| (v - top).exp()).sum::<f64>().ln()
    }

    /// The colour that suits a fit best.
    pub fn best(&self, fit: &Optimum) -> &'a Colour {
        let logs = self.logs(fit);
        let best = (0..logs.len()).max_by(|a, b| logs[*a].total_cmp(&logs[*b]));
        best.map_or(self.used, |i| &self.all[i].colour)
    }
}

/// Whitened sum of squares of a fit under each colour.
fn misfits(fit: &Optimum, used: &Colour, tints: &[Tint]) -> Vec<f64> {
    let free: Vec<usize> = (0..fit.active.len())
        .filter(|j| fit.active[*j] == 0)
        .collect();
    let columns = fit.jacobian.select_columns(&free);
    let one = |tint: &Tint| {
        let ratio: Vec<f64> = used
            .sigma
            .iter()
            .zip(&tint.colour.sigma)
            .map(|(a, b)| a / b)
            .collect();
        reweighed(&columns, &fit.residual, &ratio)
    };
    tints.iter().map(one).collect()
}

/// Sum of squares of a linear problem with its rows multiplied by `ratio`.
fn reweighed(columns: &DMatrix<f64>, residual: &DVector<f64>, ratio: &[f64]) -> f64 {
    let k = columns.ncols();
    let squares: Vec<f64> = ratio.iter().map(|r| r * r).collect();
    let weighed = |a: &[f64], b: &[f64]| -> f64 {
        a.iter()
            .zip(b)
            .zip(&squares)
            .map(|((a, b), w)| a * b * w)
            .sum()
    };
    let column = |j: usize| &columns.as_slice()[j * columns.nrows()..(j + 1) * columns.nrows()];
    let whole = weighed(residual.as_slice(), residual.as_slice());
    let normal = DMatrix::from_fn(k, k, |i, j| match i <= j {
        true => weighed(column(i), column(j)),
        false => 0.0,
    });
    let normal = DMatrix::from_fn(k, k, |i, j| normal[(i.min(j), i.max(j))]);
    let right = DVector::from_fn(k, |i, _| weighed(column(i), residual.as_slice()));
    let solved = normal.cholesky().map(|root| root.solve(&right));
    whole - solved.map_or(0.0, |step| step.dot(&right))
}
