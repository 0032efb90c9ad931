//! Errors on pieces of time that were not fitted, and what a cause gains there.

use super::channels::Channels;
use crate::findings::gain::Gain;
use nalgebra::{DMatrix, DVector};

/// Folds, each predicted from the others.
const FOLDS: usize = 10;
/// 97.5 % point of Student's t for nine degrees of freedom over that of the normal distribution.
const FEW_FOLDS: f64 = 2.262 / crate::fit::parameter::Z95;

/// Least squares of a reading on columns over some rows; columns of no size get no amplitude.
pub fn amplitudes(columns: &[&[f64]], reading: &[f64], rows: &[usize]) -> Vec<f64> {
    let m = columns.len();
    let scale: Vec<f64> = columns
        .iter()
        .map(|c| {
            let size = rows.iter().map(|i| c[*i] * c[*i]).sum::<f64>().sqrt();
            if size > 0.0 { size } else { 1.0 }
        })
        .collect();
    let dot = |a: usize, b: usize| {
        let sum: f64 = rows.iter().map(|i| columns[a][*i] * columns[b][*i]).sum();
        sum / (scale[a] * scale[b])
    };
    let mut normal = DMatrix::zeros(m, m);
    for a in 0..m {
        for b in 0..=a {
            let value = dot(a, b);
            (normal[(a, b)], normal[(b, a)]) = (value, value);
        }
        normal[(a, a)] += 1e-9;
    }
    let right = DVector::from_fn(m, |a, _| {
        let sum: f64 = rows.iter().map(|i| columns[a][*i] * reading[*i]).sum();
        sum / scale[a]
    });
    match normal.cholesky() {
        Some(root) => root
            .solve(&right)
            .iter()
            .zip(&scale)
            .map(|(x, s)| x / s)
            .collect(),
        None => vec![0.0; m],
    }
}

/// What columns with amplitudes leave of a reading.
pub fn residual(columns: &[&[f64]], amplitudes: &[f64], reading: &[f64]) -> Vec<f64> {
    let mut left = reading.to_vec();
    for (column, a) in columns.iter().zip(amplitudes) {
        left.iter_mut().zip(*column).for_each(|(l, c)| *l -= a * c);
    }
    left
}

/// How time is cut for holding out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Split {
    /// Long pieces: what is named must carry over to motion that was not seen.
    Long,
    /// Short pieces, dealt out in turn: for what shows in few places.
    Short,
}

impl Split {
    /// The fold of a row among `n`.
    fn fold(self, row: usize, n: usize) -> usize {
        let pieces = match self {
            Self::Long => FOLDS,
            Self::Short => 5 * FOLDS,
        };
        row * pieces / n % FOLDS
    }
}

/// Prediction error of every row, each fold predicted from the others.
pub fn held_out(columns: &[&[f64]], data: &Channels, split: Split) -> Vec<f64> {
    let n = data.rows();
    let mut error = vec![0.0; n];
    for fold in 0..FOLDS {
        let (inside, rest): (Vec<usize>, Vec<usize>) =
            (0..n).partition(|i| split.fold(*i, n) == fold);
        let a = amplitudes(columns, &data.twist, &rest);
        for i in inside {
            let fitted: f64 = columns.iter().zip(&a).map(|(c, a)| c[i] * a).sum();
            error[i] = data.twist[i] - fitted;
        }
    }
    error
}

/// Gain from errors before and after; its interval by leaving out each fold in turn (jackknife).
pub fn gain(before: &[f64], after: &[f64], split: Split) -> Gain {
    let n = before.len();
    let sums = |errors: &[f64]| -> Vec<f64> {
        let mut sums = vec![0.0; FOLDS];
        for (i, e) in errors.iter().enumerate() {
            sums[split.fold(i, n)] += e * e;
        }
        sums
    };
    let (b, a) = (sums(before), sums(after));
    let total = |s: &[f64]| s.iter().sum::<f64>().max(f64::MIN_POSITIVE);
    let log = |skip: usize| {
        let less = |s: &[f64]| (total(s) - s[skip]).max(f64::MIN_POSITIVE);
        0.5 * (less(&b) / less(&a)).ln()
    };
    let parts: Vec<f64> = (0..FOLDS).map(log).collect();
    let middle = super::channels::mean(&parts);
    let spread: f64 = parts.iter().map(|g| (g - middle) * (g - middle)).sum();
    let variance = spread * (FOLDS - 1) as f64 / FOLDS as f64;
    let root = |s: &[f64]| (total(s) / n as f64).sqrt();
    Gain::of(root(&b), root(&a), FEW_FOLDS * variance.sqrt())
}
