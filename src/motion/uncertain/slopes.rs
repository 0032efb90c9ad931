//! Changes of the accelerance with mass, damper and spring: `∂H = −s²Yᵀ(s²∂M + s∂D + ∂K)Y`, where Y is the
//! answer of every coordinate (`motion::receptance`). All are symmetric: six numbers a line.

use super::bodies::triangle;
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
        UPPER.map(|(a, b)| {
            let parts = entries.iter().map(|(i, j, g)| y[*i][a] * y[*j][b] * *g);
            parts.sum::<C64>() * scale
        })
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
        for (p, (a, b)) in UPPER.into_iter().enumerate() {
            let column = 12 * k + 2 * p;
            for (place, (i, j)) in triangle(n).enumerate() {
                let both = match i == j {
                    true => y[i][a] * y[i][b],
                    false => y[i][a] * y[j][b] + y[j][a] * y[i][b],
                };
                let both = both * factor;
                products[(place, column)] = both.re;
                products[(place, column + 1)] = both.im;
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
