//! Products of columns.

use nalgebra::{Cholesky, DMatrix, DMatrixView, Dyn};

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
            for (k, column) in group.iter().enumerate() {
                row[first + k] = column[i];
            }
        }
    }
    DMatrix::from_vec(columns, rows, turned)
}

/// Columns of a product with itself that are multiplied together: what lies on the other side of the diagonal is not.
const BLOCK: usize = 48;

/// aᵀa.
pub fn gram<'a>(a: impl Into<DMatrixView<'a, f64>>) -> DMatrix<f64> {
    let a = a.into();
    let count = a.ncols();
    if count <= BLOCK {
        return tr_mul(a, a);
    }
    let turned = turned(a);
    let mut product = DMatrix::zeros(count, count);
    for first in (0..count).step_by(BLOCK) {
        let (own, rest) = (BLOCK.min(count - first), count - first);
        let block = turned.rows(first, own) * a.columns(first, rest);
        product
            .view_mut((first, first), (own, rest))
            .copy_from(&block);
    }
    product.fill_lower_triangle_with_upper_triangle();
    product
}

/// The root L of a symmetric matrix LLᵀ, of which the lower half is read; block by block where it is wide, as most of the work is a
/// product then. `None` where it is not positive definite.
pub fn root(mut of: DMatrix<f64>) -> Option<Cholesky<f64, Dyn>> {
    let n = of.nrows();
    if n <= 2 * BLOCK {
        return Cholesky::new(of);
    }
    for first in (0..n).step_by(BLOCK) {
        let own = BLOCK.min(n - first);
        let (next, below) = (first + own, n - first - own);
        let corner = Cholesky::new(of.view((first, first), (own, own)).into_owned())?;
        let side = of.view((next, first), (below, own)) * inverse_root(&corner).transpose();
        for from in (next..n).step_by(BLOCK) {
            let (count, rest) = (BLOCK.min(n - from), n - from);
            let rows = side.rows(from - next, rest);
            let taken = rows * side.rows(from - next, count).transpose();
            let mut left = of.view_mut((from, from), (rest, count));
            left -= taken;
        }
        of.view_mut((first, first), (own, own))
            .copy_from(corner.l_dirty());
        of.view_mut((next, first), (below, own)).copy_from(&side);
    }
    Some(Cholesky::pack_dirty(of))
}

/// L⁻¹ of the root L of a matrix LLᵀ: the inverse of the matrix is its product with its own transpose, of
/// which an entry of the diagonal is the square of a column.
pub fn inverse_root(root: &Cholesky<f64, Dyn>) -> DMatrix<f64> {
    inverse_lower(root.l_dirty().as_view())
}

/// Inverse of a lower triangle, half by half where it is wide, as most of the work is a product then.
fn inverse_lower(lower: DMatrixView<f64>) -> DMatrix<f64> {
    let n = lower.nrows();
    if n <= 2 * BLOCK {
        return inverse_narrow(lower);
    }
    let (first, rest) = (n / 2, n - n / 2);
    let own = inverse_lower(lower.view((0, 0), (first, first)));
    let last = inverse_lower(lower.view((first, first), (rest, rest)));
    let between = -(&last * (lower.view((first, 0), (rest, first)) * &own));
    let mut inverse = DMatrix::zeros(n, n);
    inverse.view_mut((0, 0), (first, first)).copy_from(&own);
    inverse
        .view_mut((first, 0), (rest, first))
        .copy_from(&between);
    inverse
        .view_mut((first, first), (rest, rest))
        .copy_from(&last);
    inverse
}

/// The same, column by column.
fn inverse_narrow(lower: DMatrixView<f64>) -> DMatrix<f64> {
    let n = lower.nrows();
    let mut inverse = DMatrix::identity(n, n);
    for (j, mut column) in inverse.column_iter_mut().enumerate() {
        let x = column.as_mut_slice();
        for k in j..n {
            let factor = lower.column(k);
            let factor = factor.as_slice();
            x[k] /= factor[k];
            let (own, below) = x[k..].split_at_mut(1);
            let below = below.iter_mut().zip(&factor[k + 1..]);
            below.for_each(|(x, l)| *x -= l * own[0]);
        }
    }
    inverse
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_inverse_of_a_root_makes_the_inverse() {
        for n in [4, 97, 200] {
            let of = DMatrix::from_fn(n, n, |i, j| match i == j {
                true => 5.0 * n as f64,
                false => 0.3 * ((i + j) % 5) as f64,
            });
            let root = inverse_root(&of.clone().cholesky().unwrap());
            let off = root.tr_mul(&root) * of - DMatrix::identity(n, n);
            assert!(off.abs().max() < 1e-12, "{n}");
        }
    }

    #[test]
    fn a_root_by_blocks_is_that_of_the_whole() {
        for n in [96, 97, 144, 150] {
            let a = DMatrix::from_fn(n + 3, n, |i, j| ((i * 7 + j * j * 13) % 11) as f64 - 5.0);
            let of = gram(&a) + DMatrix::identity(n, n) * 3.0;
            let found = root(of.clone()).unwrap().l();
            let off = (&found - of.clone().cholesky().unwrap().l()).abs().max();
            assert!(off < 1e-9 * found.abs().max(), "{n}: {off}");
            let mut none = of;
            none[(n - 1, n - 1)] = -1.0;
            assert!(root(none).is_none());
        }
    }

    #[test]
    fn a_product_with_itself_is_that_of_dots_however_wide() {
        for n in [1, 7, 48, 49, 96, 131] {
            let a = DMatrix::from_fn(37, n, |i, j| ((i * 7 + j * 13) % 11) as f64 - 5.0);
            assert_eq!(gram(&a), a.transpose() * &a, "{n}");
        }
    }

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
