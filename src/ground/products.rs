//! Products of columns.

use nalgebra::{DMatrix, DMatrixView};

/// Columns from which a product by blocks is worth turning its first factor.
const WIDE: usize = 5;

/// aᵀb, columns by columns. Where both are wide it is taken by blocks, many times faster than dot by dot.
pub fn tr_mul<'a, 'b>(
    a: impl Into<DMatrixView<'a, f64>>,
    b: impl Into<DMatrixView<'b, f64>>,
) -> DMatrix<f64> {
    let (a, b) = (a.into(), b.into());
    match a.ncols() > WIDE && b.ncols() > WIDE {
        true => turned(a) * b,
        false => a.tr_mul(&b),
    }
}

/// Columns that are turned together: their entries lie beside one another in a turned matrix.
const TOGETHER: usize = 8;

/// aᵀ.
fn turned(a: DMatrixView<f64>) -> DMatrix<f64> {
    let (rows, columns) = a.shape();
    let mut turned = vec![0.0; rows * columns];
    for first in (0..columns).step_by(TOGETHER) {
        let count = TOGETHER.min(columns - first);
        let group: Vec<_> = (first..first + count).map(|j| a.column(j)).collect();
        let group: Vec<&[f64]> = group.iter().map(|c| c.as_slice()).collect();
        for (i, row) in turned.chunks_exact_mut(columns).enumerate() {
            let places = row[first..first + count].iter_mut();
            places.zip(&group).for_each(|(to, column)| *to = column[i]);
        }
    }
    DMatrix::from_vec(columns, rows, turned)
}

/// aᵀa.
pub fn gram<'a>(a: impl Into<DMatrixView<'a, f64>>) -> DMatrix<f64> {
    let a = a.into();
    tr_mul(a, a)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wide_and_narrow_products_are_those_of_dots() {
        let of = |n: usize| DMatrix::from_fn(40, n, |i, j| ((i * 7 + j * 13) % 11) as f64 - 5.0);
        for (n, m) in [(3, 9), (9, 3), (8, 12)] {
            let (a, b) = (of(n), of(m) * 0.5);
            let off = tr_mul(&a, &b) - a.tr_mul(&b);
            assert!(off.abs().max() < 1e-9);
        }
    }
}
