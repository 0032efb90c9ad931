//! Chebyshev nodes and the matrix that differentiates at them (Trefethen 2000, Spectral Methods, ch. 6).

use nalgebra::DMatrix;
use std::f64::consts::PI;

/// A part of a tooth passing in which the cut is smooth, s from its start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stretch {
    /// Its middle.
    pub middle_s: f64,
    /// Its length.
    pub length_s: f64,
    /// Whether any tooth cuts.
    pub cutting: bool,
}

/// `count` nodes from 0 to 1, both included.
pub fn nodes(count: usize) -> Vec<f64> {
    let last = (count.max(2) - 1) as f64;
    (0..count.max(2))
        .map(|i| 0.5 * (1.0 - (PI * i as f64 / last).cos()))
        .collect()
}

/// Differentiates over 0 to 1 what is given at [`nodes`].
pub fn differentiation(count: usize) -> DMatrix<f64> {
    let x = nodes(count);
    let n = x.len();
    let weight = |i: usize| {
        let end = if i == 0 || i == n - 1 { 2.0 } else { 1.0 };
        if i.is_multiple_of(2) { end } else { -end }
    };
    let mut slope = DMatrix::from_fn(n, n, |i, j| match i == j {
        true => 0.0,
        false => weight(i) / weight(j) / (x[i] - x[j]),
    });
    for i in 0..n {
        let sum: f64 = slope.row(i).sum();
        slope[(i, i)] = -sum;
    }
    slope
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::DVector;

    #[test]
    fn a_sine_is_differentiated_to_the_last_digits() {
        let x = nodes(20);
        let values = DVector::from_iterator(20, x.iter().map(|x| (3.0 * x).sin()));
        let slope = differentiation(20) * values;
        for (s, x) in slope.iter().zip(x) {
            assert!((s - 3.0 * (3.0 * x).cos()).abs() < 1e-10);
        }
    }
}
