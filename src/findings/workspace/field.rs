//! The linear-Gaussian algebra: what the data say of every set of columns, with the springs free
//! within their stated spread.

use super::bound::{Bound, Bounded};
use super::columns::Columns;
use super::gram::Gram;
use nalgebra::{DMatrix, DVector};

/// All columns seen through the data.
#[derive(Debug, Clone)]
pub struct Field {
    gram: Gram,
    gradient: DVector<f64>,
    /// Misfit of no cause at all, in squared standard deviations.
    pub base: f64,
    prior: Vec<f64>,
    bounds: Vec<Bound>,
}

/// Amounts after the data.
#[derive(Debug, Clone, PartialEq)]
pub struct Amounts {
    /// Mean of every column asked for.
    pub mean: Vec<f64>,
    /// Logarithm of the evidence over that of no cause.
    pub evidence: f64,
    /// Half the misfit that they take away.
    pub nats: f64,
}

/// What is free in every set: the springs of the model as columns of relative compliance (in standard deviations of the readings)
/// with the spread stated for them, and the place of the target (`target`).
pub struct Springs {
    /// One column for each spring, then three for the target.
    pub columns: DMatrix<f64>,
    /// Relative standard deviation.
    pub spread: f64,
}

impl Springs {
    /// Squares that are left of rows (in standard deviations) when the springs move within their spread.
    pub fn left(&self, rows: &DVector<f64>) -> f64 {
        let b = &self.columns;
        let mut inner = b.tr_mul(b);
        (0..inner.nrows()).for_each(|i| inner[(i, i)] += self.spread.powi(-2));
        let right = b.tr_mul(rows);
        let taken = inner
            .cholesky()
            .map_or(0.0, |root| right.dot(&root.solve(&right)));
        rows.norm_squared() - taken
    }
}

impl Field {
    /// Of `readings` less the simulation and the columns with their priors, all in standard
    /// deviations of the readings.
    pub fn new(
        readings: &DVector<f64>,
        columns: &Columns,
        springs: &Springs,
        (prior, bounds): (Vec<f64>, Vec<Bound>),
    ) -> Self {
        let mut base = readings.norm_squared();
        let b = &springs.columns;
        let head = b.rows(0, columns.slopes());
        let mut inner = head.tr_mul(&head);
        (0..inner.nrows()).for_each(|i| inner[(i, i)] += springs.spread.powi(-2));
        let root = inner.cholesky();
        let taken = root.as_ref().map(|root| columns.taken(b, root));
        let mut gradient = columns.gradient(readings);
        if let (Some(root), Some(taken)) = (&root, &taken) {
            let right = b.tr_mul(readings);
            let solved = root.l_dirty().solve_lower_triangular(&right);
            if let Some(solved) = solved {
                gradient -= taken.tr_mul(&solved);
                base -= solved.norm_squared();
            }
        }
        let gram = Gram::of(columns, taken);
        Self {
            gram,
            gradient,
            base,
            prior,
            bounds,
        }
    }

    /// What the data say of columns together whose priors are so many times as wide.
    pub fn amounts(&self, columns: &[usize], width: impl Fn(usize) -> f64) -> Amounts {
        let n = columns.len();
        let spread = |i: usize| width(i) * self.prior[columns[i]];
        // in units of the prior, H = I + T G T
        let mut h = vec![0.0; n * n];
        let mut g = vec![0.0; n];
        for i in 0..n {
            for j in 0..=i {
                h[i * n + j] = spread(i) * spread(j) * self.gram.of_both(columns[i], columns[j]);
            }
            h[i * n + i] += 1.0;
            g[i] = spread(i) * self.gradient[columns[i]];
        }
        let log_det = factor(&mut h, n);
        let mean = solve(&h, n, &g);
        let product: f64 = g.iter().zip(&mean).map(|(a, b)| a * b).sum();
        let before: Vec<f64> = (0..n).map(spread).collect();
        let mean: Vec<f64> = mean.iter().zip(&before).map(|(m, s)| m * s).collect();
        let deviation = |weights: &[f64]| {
            let own: Vec<f64> = weights.iter().zip(&before).map(|(w, s)| w * s).collect();
            forward(&h, n, &own)
                .iter()
                .map(|x| x * x)
                .sum::<f64>()
                .sqrt()
        };
        let bounds: Vec<Bound> = columns.iter().map(|c| self.bounds[*c]).collect();
        let bounded = Bounded {
            bounds: &bounds,
            mean: &mean,
            before: &before,
            after: &deviation,
        };
        Amounts {
            evidence: 0.5 * product - 0.5 * log_det + bounded.ln_kept(),
            nats: self.explained(columns, &mean),
            mean,
        }
    }

    /// Half the misfit that amounts take away.
    pub fn explained(&self, columns: &[usize], amounts: &[f64]) -> f64 {
        let mut sum = 0.0;
        for (i, a) in columns.iter().zip(amounts) {
            sum += a * self.gradient[*i];
            for (j, b) in columns.iter().zip(amounts) {
                sum -= 0.5 * a * b * self.gram.of_both(*i, *j);
            }
        }
        sum
    }

    /// Curvature and slope of the misfit over these columns in units of their priors.
    pub fn quadratic(&self, columns: &[usize]) -> (DMatrix<f64>, DVector<f64>) {
        let n = columns.len();
        let t = |i: usize| self.prior[columns[i]];
        let gram = DMatrix::from_fn(n, n, |i, j| {
            t(i) * t(j) * self.gram.of_both(columns[i], columns[j])
        });
        let gradient = DVector::from_fn(n, |i, _| t(i) * self.gradient[columns[i]]);
        (gram, gradient)
    }

    /// Precision that the data alone give a column, one over its units.
    pub fn precision(&self, column: usize) -> f64 {
        self.gram.of_both(column, column).max(0.0).sqrt()
    }

    /// Lowest value of a column.
    pub fn low(&self, column: usize) -> f64 {
        self.bounds[column].low()
    }

    /// Prior standard deviation of a column.
    pub fn prior(&self, column: usize) -> f64 {
        self.prior[column]
    }
}

/// Cholesky's factor in the lower triangle; logarithm of the determinant.
fn factor(h: &mut [f64], n: usize) -> f64 {
    let mut log_det = 0.0;
    for j in 0..n {
        for k in 0..j {
            let own = h[j * n + k];
            for i in j..n {
                h[i * n + j] -= h[i * n + k] * own;
            }
        }
        let pivot = h[j * n + j].max(1e-300).sqrt();
        log_det += 2.0 * pivot.ln();
        (j..n).for_each(|i| h[i * n + j] /= pivot);
    }
    log_det
}

/// (LLᵀ)⁻¹ g.
fn solve(l: &[f64], n: usize, g: &[f64]) -> Vec<f64> {
    let mut x = forward(l, n, g);
    for i in (0..n).rev() {
        let rest: f64 = (i + 1..n).map(|j| l[j * n + i] * x[j]).sum();
        x[i] = (x[i] - rest) / l[i * n + i];
    }
    x
}

/// L⁻¹ g.
fn forward(l: &[f64], n: usize, g: &[f64]) -> Vec<f64> {
    let mut x = vec![0.0; n];
    for i in 0..n {
        let rest: f64 = (0..i).map(|j| l[i * n + j] * x[j]).sum();
        x[i] = (g[i] - rest) / l[i * n + i];
    }
    x
}
