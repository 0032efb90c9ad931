//! The linear-Gaussian update, with its evidence: y = Σ Φ_f z_f + e, z_f ~ N(0, σ² a_f² I),
//! e ~ N(0, σ² I), σ² with a scaled inverse chi-square prior about 1.
//!
//! The size a_f of a block is given, or the one of greatest evidence (type-II maximum likelihood by
//! expectation and maximisation: MacKay 1992; Tipping 2001). With σ² integrated out the evidence is
//! Student's: ln E = −(n+ν)/2 · ln((ν+Q)/(ν+n)) − ½ ln det(I + A GA), Q what the blocks leave of |y|².

use crate::ground::products::{gram, inverse_root, root};
use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

/// Products of the columns of all blocks with one another and with the reading.
#[derive(Debug, Clone)]
pub struct Products {
    /// ΦᵀΦ, columns × columns.
    pub gram: DMatrix<f64>,
    /// Φᵀy.
    pub right: DVector<f64>,
}

/// The reading as the evidence sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reading {
    /// |y|², in squared noise deviations.
    pub square: f64,
    /// Rows that carry information: rows less unknowns that were projected out.
    pub rows: f64,
    /// Rows that the stated noise is worth: 0 where nobody stated it, infinite where it is certain.
    pub noise_rows: f64,
}

/// How large the amounts of a block are before the data.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Size {
    /// Their standard deviation, in noise deviations per unit of the columns.
    Given(f64),
    /// That of greatest evidence.
    Free,
    /// That of greatest evidence, for many amounts that are drawn together: what their prior does not need
    /// costs nothing, so that they need no price one by one.
    Drawn,
}

/// What the data say of the amounts of all blocks.
#[derive(Debug, Clone)]
pub struct Posterior {
    /// Means, in units of the columns.
    pub mean: DVector<f64>,
    /// Covariance, in squared noise deviations (times [`Posterior::noise_variance`] for that of the amounts).
    pub covariance: DMatrix<f64>,
    /// Size of every block.
    pub sizes: Vec<f64>,
    /// Squares that are left and that the sizes cost, Q.
    pub left: f64,
    /// Estimated σ²: 1 where the noise is as stated.
    pub noise_variance: f64,
    /// Logarithm of the evidence.
    pub ln_evidence: f64,
}

/// First guess of a free size, noise deviations: an effect that is plainly seen.
const FIRST: f64 = 10.0;
/// Steps of expectation and maximisation: more change ln E by less than the choice notices.
const STEPS: usize = 5;
/// Fewest amounts that data may fix of drawn ones.
const FEWEST: f64 = 0.1;
/// Least and largest free size.
const BOUNDS: (f64, f64) = (1e-3, 1e6);

impl Reading {
    /// ln E of noise alone that left `q`, up to a constant of the data.
    pub fn ln_evidence(&self, q: f64) -> f64 {
        let q = q.max(1e-12 * self.square).max(f64::MIN_POSITIVE);
        if self.noise_rows.is_infinite() {
            return -0.5 * q;
        }
        let total = self.rows + self.noise_rows;
        -0.5 * total * ((self.noise_rows + q) / total).ln()
    }

    /// σ² by what is left.
    pub fn noise_variance(&self, q: f64) -> f64 {
        if self.noise_rows.is_infinite() {
            return 1.0;
        }
        let rows = (self.rows + self.noise_rows).max(1.0);
        ((self.noise_rows + q.max(0.0)) / rows).max(f64::MIN_POSITIVE)
    }
}

/// Posterior of blocks of columns: `blocks` holds the number of columns and the size of each, in order.
/// `None` where the products are not finite.
pub fn update(
    products: &Products,
    reading: &Reading,
    blocks: &[(usize, Size)],
) -> Option<Posterior> {
    let mut sizes: Vec<f64> = blocks.iter().map(|b| first(b.1)).collect();
    let free = blocks.iter().any(|b| !matches!(b.1, Size::Given(_)));
    for _ in 0..if free { STEPS } else { 0 } {
        let solved = Solved::of(products, reading, each_of(blocks, &sizes))?;
        sizes = grown(&solved, reading, blocks, &sizes);
    }
    with_sizes(products, reading, blocks, &sizes)
}

/// The size of every column.
fn each_of(blocks: &[(usize, Size)], sizes: &[f64]) -> Vec<f64> {
    let each = |(block, size): (&(usize, Size), &f64)| vec![*size; block.0];
    blocks.iter().zip(sizes).flat_map(each).collect()
}

fn first(size: Size) -> f64 {
    match size {
        Size::Given(a) => a,
        Size::Free | Size::Drawn => FIRST,
    }
}

/// One step: a² ← (|m|²/σ² + tr V)/p for the free blocks; for drawn ones |m|²/σ² over the number of amounts
/// that the data fix (MacKay 1992), which arrives sooner where they fix few of many.
fn grown(solved: &Solved, reading: &Reading, blocks: &[(usize, Size)], old: &[f64]) -> Vec<f64> {
    let mut at = 0;
    let mut sizes = old.to_vec();
    let (mean, root) = (solved.mean(), inverse_root(&solved.root));
    let noise_variance = reading.noise_variance(solved.left);
    for (size, (count, kind)) in sizes.iter_mut().zip(blocks) {
        let own = at..at + count;
        at += count;
        let variance = |i: usize| solved.scale[i].powi(2) * root.column(i).norm_squared();
        let left: f64 = own.clone().map(variance).sum();
        let moved = own.map(|i| mean[i] * mean[i]).sum::<f64>() / noise_variance;
        let square = match kind {
            Size::Given(_) => continue,
            Size::Free => (moved + left) / (*count).max(1) as f64,
            Size::Drawn => moved / (*count as f64 - left / (*size * *size)).max(FEWEST),
        };
        *size = square.sqrt().clamp(BOUNDS.0, BOUNDS.1);
    }
    sizes
}

/// Mean of the amounts and ln E where every size is given: for many columns, whose covariance nobody asks
/// for. `None` where the products are not finite.
pub fn evidence(
    products: &Products,
    reading: &Reading,
    blocks: &[(usize, f64)],
) -> Option<(DVector<f64>, f64)> {
    let each = blocks.iter().flat_map(|b| std::iter::repeat_n(b.1, b.0));
    let solved = Solved::of(products, reading, each.collect())?;
    Some((solved.mean(), solved.ln_evidence(reading)))
}

/// The normal equations in units of the sizes, solved.
struct Solved {
    scale: Vec<f64>,
    root: Cholesky<f64, Dyn>,
    amounts: DVector<f64>,
    left: f64,
}

impl Solved {
    fn of(products: &Products, reading: &Reading, scale: Vec<f64>) -> Option<Self> {
        let n = scale.len();
        let entry = |i: usize, j: usize| {
            scale[i] * scale[j] * products.gram[(i, j)] + f64::from(u8::from(i == j))
        };
        let root = root(DMatrix::from_fn(n, n, entry))?;
        let right = DVector::from_fn(n, |i, _| scale[i] * products.right[i]);
        let amounts = root.solve(&right);
        Some(Self {
            left: reading.square - right.dot(&amounts),
            scale,
            root,
            amounts,
        })
    }

    fn mean(&self) -> DVector<f64> {
        DVector::from_fn(self.scale.len(), |i, _| self.scale[i] * self.amounts[i])
    }

    fn ln_evidence(&self, reading: &Reading) -> f64 {
        let diagonal = self.root.l_dirty().diagonal();
        // half of ln det, that is of twice the sum over the root
        reading.ln_evidence(self.left) - diagonal.iter().map(|d| d.ln()).sum::<f64>()
    }
}

fn with_sizes(
    products: &Products,
    reading: &Reading,
    blocks: &[(usize, Size)],
    sizes: &[f64],
) -> Option<Posterior> {
    let solved = Solved::of(products, reading, each_of(blocks, sizes))?;
    let inverse = gram(&inverse_root(&solved.root));
    let (n, scale) = (solved.scale.len(), &solved.scale);
    Some(Posterior {
        mean: solved.mean(),
        covariance: DMatrix::from_fn(n, n, |i, j| scale[i] * scale[j] * inverse[(i, j)]),
        sizes: sizes.to_vec(),
        noise_variance: reading.noise_variance(solved.left),
        ln_evidence: solved.ln_evidence(reading),
        left: solved.left,
    })
}

/// The amounts x that minimise ½ xᵀHx − bᵀx with |x| at most `most` (infinite: free), by an active set: the
/// worst offender is held at its limit and the rest solved again. Zeros where H is not positive definite.
pub fn limited(hessian: &DMatrix<f64>, right: &DVector<f64>, most: &[f64]) -> DVector<f64> {
    let n = right.len();
    let mut held: Vec<Option<f64>> = vec![None; n];
    loop {
        let free: Vec<usize> = (0..n).filter(|i| held[*i].is_none()).collect();
        let fixed = |j: usize| held[j].unwrap_or(0.0);
        let pull = |i: &usize| right[*i] - (0..n).map(|j| hessian[(*i, j)] * fixed(j)).sum::<f64>();
        let own = hessian.select_rows(&free).select_columns(&free);
        let own_right = DVector::from_iterator(free.len(), free.iter().map(pull));
        let Some(root) = root(own) else {
            return DVector::zeros(n);
        };
        let solved = root.solve(&own_right);
        let over = |k: &usize| solved[*k].abs() / most[free[*k]];
        let worst = (0..free.len()).max_by(|a, b| over(a).total_cmp(&over(b)));
        match worst.filter(|k| over(k) > 1.0) {
            Some(k) => held[free[k]] = Some(most[free[k]].copysign(solved[k])),
            None => {
                let mut x = DVector::from_fn(n, |j, _| fixed(j));
                free.iter().zip(solved.iter()).for_each(|(i, v)| x[*i] = *v);
                return x;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn products(columns: &[Vec<f64>], y: &[f64]) -> Products {
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
        let n = columns.len();
        Products {
            gram: DMatrix::from_fn(n, n, |i, j| dot(&columns[i], &columns[j])),
            right: DVector::from_fn(n, |i, _| dot(&columns[i], y)),
        }
    }

    fn reading(y: &[f64], noise_rows: f64) -> Reading {
        Reading {
            square: y.iter().map(|v| v * v).sum(),
            rows: y.len() as f64,
            noise_rows,
        }
    }

    #[test]
    fn evidence_is_that_of_the_joint_density() {
        // ln N(y; 0, I + a²φφᵀ) up to the constant, by hand
        let (y, phi, a) = ([1.0, -2.0, 0.5], vec![0.5, 1.0, 2.0], 1.7);
        let covariance = DMatrix::from_fn(3, 3, |i, j| {
            a * a * phi[i] * phi[j] + f64::from(u8::from(i == j))
        });
        let root = covariance.clone().cholesky().unwrap();
        let v = DVector::from_row_slice(&y);
        let wanted = -0.5 * v.dot(&root.solve(&v)) - 0.5 * covariance.determinant().ln();
        let found = update(
            &products(&[phi], &y),
            &reading(&y, f64::INFINITY),
            &[(1, Size::Given(a))],
        );
        assert!((found.unwrap().ln_evidence - wanted).abs() < 1e-12);
    }

    #[test]
    fn a_free_size_finds_the_effect_and_shrinks_what_is_not_there() {
        let phi: Vec<f64> = (0..50).map(|i| (f64::from(i) * 0.3).sin()).collect();
        let other: Vec<f64> = (0..50).map(|i| (f64::from(i) * 1.1).cos()).collect();
        let noise = |i: usize| [0.3, -0.9, 1.2, -0.4, -0.2][i % 5];
        let y: Vec<f64> = (0..50).map(|i| 6.0 * phi[i] + noise(i)).collect();
        let found = update(
            &products(&[phi, other], &y),
            &reading(&y, 0.0),
            &[(1, Size::Free), (1, Size::Free)],
        )
        .unwrap();
        assert!((found.mean[0] - 6.0).abs() < 0.3, "{found:?}");
        assert!(found.sizes[1] < 0.2 * found.sizes[0], "{found:?}");
    }

    #[test]
    fn a_limit_holds_and_the_others_make_up_for_it() {
        let hessian = DMatrix::from_row_slice(2, 2, &[2.0, 1.0, 1.0, 2.0]);
        let right = DVector::from_row_slice(&[6.0, 0.0]);
        let found = limited(&hessian, &right, &[1.0, f64::INFINITY]);
        assert!(
            (found[0] - 1.0).abs() < 1e-12 && (found[1] + 0.5).abs() < 1e-12,
            "{found}"
        );
    }

    #[test]
    fn unstated_noise_is_estimated() {
        let y = [2.0, -2.0, 2.0, -2.0];
        let found = update(&products(&[], &y), &reading(&y, 0.0), &[]).unwrap();
        assert!((found.noise_variance - 4.0).abs() < 1e-12);
    }
}
