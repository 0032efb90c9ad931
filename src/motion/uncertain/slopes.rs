//! Changes of the accelerance with mass, damper and spring: `∂H = −s²Yᵀ(s²∂M + s∂D + ∂K)Y`, where Y is the
//! answer of every coordinate (`motion::receptance`). All are symmetric: six numbers a line.

use crate::motion::frf::{C64, Response};
use nalgebra::DMatrix;

/// Pairs of directions of a symmetric 3×3 matrix.
pub const UPPER: [(usize, usize); 6] = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)];

/// A symmetric change on one line, in the order of [`UPPER`].
pub type Upper = [C64; 6];

/// Row, column and value of a symmetric matrix; both triangles are listed.
pub type Entry = (usize, usize, f64);

/// The whole of a symmetric change.
pub fn whole(upper: &Upper) -> Response {
    let mut a = Response::default();
    for ((i, j), v) in UPPER.into_iter().zip(upper) {
        a[i][j] = *v;
        a[j][i] = *v;
    }
    a
}

/// `−s²·YᵀGY` per line for the matrix G with these entries, times `factor(s)`: 1 for a spring, s for a
/// damper, s² for a mass. `answers` has `n` coordinates a line.
pub fn of_entries(
    entries: &[Entry],
    factor: impl Fn(C64) -> C64,
    (answers, n): (&[[C64; 3]], usize),
    s: &[C64],
) -> Vec<Upper> {
    let line = |(k, s): (usize, &C64)| {
        let y = &answers[k * n..(k + 1) * n];
        let scale = -s * s * factor(*s);
        let mut sum = Upper::default();
        for (i, j, g) in entries {
            let (left, right) = (&y[*i], y[*j].map(|y| y * *g));
            for (sum, (a, b)) in sum.iter_mut().zip(UPPER) {
                *sum += left[a] * right[b];
            }
        }
        sum.map(|sum| sum * scale)
    };
    s.iter().enumerate().map(line).collect()
}

/// `−s⁴·YᵀGY` of many directions G of the mass matrix, each a row of `directions` (upper triangle by
/// rows): one product of matrices for all lines. `[direction][line]`.
pub fn of_masses(
    directions: &DMatrix<f64>,
    (answers, n): (&[[C64; 3]], usize),
    s: &[C64],
) -> Vec<Vec<Upper>> {
    let mut products = DMatrix::zeros(n * (n + 1) / 2, 12 * s.len());
    for (k, s) in s.iter().enumerate() {
        let y = &answers[k * n..(k + 1) * n];
        let factor = -(s * s) * (s * s);
        let mut columns = products.columns_mut(12 * k, 12);
        let mut place = 0;
        for i in 0..n {
            let left = y[i].map(|y| y * factor);
            for (j, right) in y.iter().enumerate().skip(i) {
                for (p, (a, b)) in UPPER.into_iter().enumerate() {
                    let mut both = left[a] * right[b];
                    if i != j {
                        both += left[b] * right[a];
                    }
                    columns[(place, 2 * p)] = both.re;
                    columns[(place, 2 * p + 1)] = both.im;
                }
                place += 1;
            }
        }
    }
    let all = directions * products;
    let entry = |row: usize, k: usize, p: usize| {
        C64::new(all[(row, 12 * k + 2 * p)], all[(row, 12 * k + 2 * p + 1)])
    };
    let line = |row: usize, k: usize| std::array::from_fn(|p| entry(row, k, p));
    (0..directions.nrows())
        .map(|row| (0..s.len()).map(|k| line(row, k)).collect())
        .collect()
}
