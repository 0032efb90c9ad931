//! Does a cause help where it was not fitted? Whole points are left out in turn, and predicted.

use crate::findings::gain::Gain;
use crate::fit::force_steps::quantile;
use crate::fit::parameter::Z95;
use nalgebra::{DMatrix, DVector};

/// Readings with everything linear that may explain them, row by row in standard deviations.
pub struct Rows<'a> {
    /// Readings less the simulation.
    pub readings: &'a DVector<f64>,
    /// The springs of the model, then the amounts of causes.
    pub columns: DMatrix<f64>,
    /// Standard deviation of every column before the data.
    pub prior: Vec<f64>,
}

/// What is left of every row that is predicted from the rows of the other folds; rows without a
/// fold are always fitted, and come back as NaN.
pub fn held_out(rows: &Rows, folds: &[Option<usize>]) -> Vec<f64> {
    let d = &rows.columns;
    let mut normal = d.tr_mul(d);
    for (i, prior) in rows.prior.iter().enumerate() {
        normal[(i, i)] += prior.powi(-2);
    }
    let gradient = d.tr_mul(rows.readings);
    let mut out = vec![f64::NAN; folds.len()];
    let count = folds.iter().flatten().max().map_or(0, |m| m + 1);
    for fold in 0..count {
        let own: Vec<usize> = (0..folds.len())
            .filter(|i| folds[*i] == Some(fold))
            .collect();
        let part = d.select_rows(&own);
        let read = rows.readings.select_rows(&own);
        let rest = &normal - part.tr_mul(&part);
        let right = &gradient - part.tr_mul(&read);
        let Some(root) = rest.cholesky() else {
            continue;
        };
        let left = read - &part * root.solve(&right);
        own.iter().zip(left.iter()).for_each(|(i, r)| out[*i] = *r);
    }
    out
}

/// Gain from what is left before and after; `unit` is the standard deviation of an ordinary
/// reading. The interval is that of leaving out one fold at a time (jackknife).
pub fn gain(before: &[f64], after: &[f64], folds: &[Option<usize>], unit: f64) -> Gain {
    let count = folds.iter().flatten().max().map_or(0, |m| m + 1);
    let mut sums = vec![[0.0; 2]; count];
    let mut rows = 0.0_f64;
    for (i, fold) in folds.iter().enumerate() {
        if let (Some(fold), true) = (fold, before[i].is_finite() && after[i].is_finite()) {
            sums[*fold][0] += before[i].powi(2);
            sums[*fold][1] += after[i].powi(2);
            rows += 1.0;
        }
    }
    sums.retain(|s| s[0] + s[1] > 0.0);
    let total = sums
        .iter()
        .fold([0.0; 2], |t, s| [t[0] + s[0], t[1] + s[1]]);
    let ratio = |s: [f64; 2]| 0.5 * (s[0].max(1e-30) / s[1].max(1e-30)).ln();
    let n = sums.len() as f64;
    let less: Vec<f64> = sums
        .iter()
        .map(|s| ratio([total[0] - s[0], total[1] - s[1]]))
        .collect();
    let mean = less.iter().sum::<f64>() / n.max(1.0);
    let squares: f64 = less.iter().map(|l| (l - mean).powi(2)).sum();
    let std = match n > 1.0 {
        true => ((n - 1.0) / n * squares).sqrt() * quantile(n - 1.0) / Z95,
        false => f64::INFINITY,
    };
    let rms = |s: f64| unit * (s / rows.max(1.0)).sqrt();
    Gain::of(
        rms(total[0]),
        rms(total[1]).max(f64::MIN_POSITIVE),
        std.min(1e3),
    )
}
