//! Errors on pieces of time that were not fitted, and what a cause gains there.

use super::channels::Channels;
use crate::findings::gain::Gain;
use nalgebra::{DMatrix, DVector};

/// Pieces of the record, each predicted from the others.
const PIECES: usize = 10;
/// 97.5 % point of Student's t for nine degrees of freedom over that of the normal distribution.
const FEW_PIECES: f64 = 2.262 / crate::fit::parameter::Z95;

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
        Some(root) => (0..m).map(|j| j).zip(root.solve(&right).iter()).map(|(j, x)| x / scale[j]).collect(),
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

/// Prediction error of every row, each piece of time predicted from the others.
pub fn held_out(columns: &[&[f64]], data: &Channels) -> Vec<f64> {
    let n = data.rows();
    let mut error = vec![0.0; n];
    for piece in 0..PIECES {
        let inside = n * piece / PIECES..n * (piece + 1) / PIECES;
        let rest: Vec<usize> = (0..n).filter(|i| !inside.contains(i)).collect();
        let a = amplitudes(columns, &data.twist, &rest);
        for i in inside {
            let fitted: f64 = columns.iter().zip(&a).map(|(c, a)| c[i] * a).sum();
            error[i] = data.twist[i] - fitted;
        }
    }
    error
}

/// Gain from errors before and after; its interval by leaving out each piece in turn (jackknife).
pub fn gain(before: &[f64], after: &[f64]) -> Gain {
    let n = before.len();
    let sums = |errors: &[f64]| -> Vec<f64> {
        (0..PIECES)
            .map(|p| {
                let inside = &errors[n * p / PIECES..n * (p + 1) / PIECES];
                inside.iter().map(|e| e * e).sum()
            })
            .collect()
    };
    let (b, a) = (sums(before), sums(after));
    let total = |s: &[f64]| s.iter().sum::<f64>().max(f64::MIN_POSITIVE);
    let log = |skip: Option<usize>| {
        let less = |s: &[f64]| total(s) - skip.map_or(0.0, |p| s[p]);
        let ratio = less(&b).max(f64::MIN_POSITIVE) / less(&a).max(f64::MIN_POSITIVE);
        0.5 * ratio.ln()
    };
    let parts: Vec<f64> = (0..PIECES).map(|p| log(Some(p))).collect();
    let middle = super::channels::mean(&parts);
    let spread: f64 = parts.iter().map(|g| (g - middle) * (g - middle)).sum();
    let variance = spread * (PIECES - 1) as f64 / PIECES as f64;
    let root = |s: &[f64]| (total(s) / n as f64).sqrt();
    Gain::of(root(&b), root(&a), FEW_PIECES * variance.sqrt())
}
