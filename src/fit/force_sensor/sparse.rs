//! What a hose adds, told by as few entries of R as the readings ask for: chosen one by one by the error at
//! orientations that were left out, fitted together with the physical model. A hose that pulls along one axis
//! of the sensor costs one or two numbers instead of ten per channel.

use super::fitted::{Fitted, rms};
use super::poses::Pose;
use super::remainder::terms;
use super::statics::{N, sizes, slopes};
use crate::ground::products;
use crate::ground::spatial::of_quaternion;
use crate::measurement::force_sensor::quaternion;
use nalgebra::{Cholesky, DMatrix, DVector};

/// A remainder of few terms.
pub(super) struct Sparse {
    /// Coefficients of the even quadratic, six channels, N and N·m.
    pub(super) coefficients: [[f64; 6]; 10],
    /// Error at orientations left out: forces, N, and moments, N·m.
    pub(super) held_out: [f64; 2],
}

/// A channel and an entry of R, row by row.
type Term = (usize, usize);

/// A term is worth taking from this fall of the held-out squares on, in variances of its channel: the best of
/// 54 terms that are not there falls by 7 now and then.
const WORTH: f64 = 9.0;
/// Stiffness with which a coefficient is held to zero: hardly.
const HELD: f64 = 1e-4;

/// Readings, physical model and terms in noise deviations.
struct Bench<'a> {
    poses: &'a [Pose],
    fitted: &'a Fitted,
    folds: &'a [Vec<usize>],
    /// Six rows per pose, physical parameters in natural sizes.
    physical: DMatrix<f64>,
    target: DVector<f64>,
    size: [f64; N],
}

impl Sparse {
    /// Of the residuals of a fit; none where no term is worth it.
    pub(super) fn of(poses: &[Pose], fitted: &Fitted, folds: &[Vec<usize>]) -> Option<Self> {
        let bench = Bench::new(poses, fitted, folds);
        let mut chosen: Vec<Term> = Vec::new();
        let mut errors = bench.held_out(&chosen)?;
        let most = (6 * poses.len()).saturating_sub(N) / 3;
        while chosen.len() < most {
            let Some((term, fall)) = bench.best(&chosen, &errors) else {
                break;
            };
            if fall < WORTH {
                break;
            }
            chosen.push(term);
            errors = bench.held_out(&chosen)?;
        }
        (!chosen.is_empty()).then(|| Self {
            coefficients: bench.coefficients(&chosen),
            held_out: bench.in_units(&errors),
        })
    }
}

impl<'a> Bench<'a> {
    fn new(poses: &'a [Pose], fitted: &'a Fitted, folds: &'a [Vec<usize>]) -> Self {
        let size = sizes(fitted.p[0].abs().max(1e-6));
        let rows = 6 * poses.len();
        let slopes: Vec<_> = poses
            .iter()
            .map(|p| slopes(&fitted.p, p.quaternion))
            .collect();
        let sigma = |row: usize| fitted.noise[row % 6 / 3];
        Self {
            physical: DMatrix::from_fn(rows, N, |row, j| {
                slopes[row / 6][row % 6][j] * size[j] / sigma(row)
            }),
            target: DVector::from_fn(rows, |row, _| {
                fitted.residual[row / 6][row % 6] / sigma(row)
            }),
            poses,
            fitted,
            folds,
            size,
        }
    }

    fn design(&self, chosen: &[Term]) -> DMatrix<f64> {
        let entries: Vec<[f64; 9]> = self.poses.iter().map(|p| entries(p.quaternion)).collect();
        DMatrix::from_fn(self.physical.nrows(), N + chosen.len(), |row, j| {
            match j.checked_sub(N) {
                None => self.physical[(row, j)],
                Some(k) if chosen[k].0 == row % 6 => entries[row / 6][chosen[k].1],
                Some(_) => 0.0,
            }
        })
    }

    /// Normal equations with the priors about zero.
    fn normal(&self, design: &DMatrix<f64>) -> (DMatrix<f64>, DVector<f64>) {
        let (mut gram, mut right) = (products::gram(design), design.tr_mul(&self.target));
        for j in 0..N {
            let stiffness = (self.size[j] / self.fitted.prior[j]).powi(2);
            gram[(j, j)] += stiffness.max(1e-6);
            right[j] -= stiffness * self.fitted.p[j] / self.size[j];
        }
        (N..design.ncols()).for_each(|j| gram[(j, j)] += HELD);
        (gram, right)
    }

    /// Error of every row at orientations left out, noise deviations.
    fn held_out(&self, chosen: &[Term]) -> Option<DVector<f64>> {
        let design = self.design(chosen);
        let (gram, right) = self.normal(&design);
        let mut errors = self.target.clone();
        for fold in self.folds {
            let rows: Vec<usize> = fold.iter().flat_map(|i| 6 * i..6 * i + 6).collect();
            let (own, held) = (design.select_rows(&rows), self.target.select_rows(&rows));
            let rest = Cholesky::new(&gram - products::gram(&own))?;
            let left = &held - &own * rest.solve(&(&right - own.tr_mul(&held)));
            rows.iter()
                .zip(left.iter())
                .for_each(|(row, e)| errors[*row] = *e);
        }
        Some(errors)
    }

    /// The term that lowers the held-out squares most, each channel in its own variance.
    fn best(&self, chosen: &[Term], errors: &DVector<f64>) -> Option<(Term, f64)> {
        let before = squares(errors);
        let count = self.poses.len() as f64;
        let all = (0..6).flat_map(|c| (0..9).map(move |e| (c, e)));
        let fall = |term: Term| {
            let with: Vec<Term> = chosen.iter().copied().chain([term]).collect();
            let after = squares(&self.held_out(&with)?);
            let own = |c: usize| (before[c] - after[c]) * count / before[c].max(f64::MIN_POSITIVE);
            Some((term, (0..6).map(own).sum::<f64>()))
        };
        let tried = all.filter(|term| !chosen.contains(term)).filter_map(fall);
        tried.reduce(|best, next| if next.1 > best.1 { next } else { best })
    }

    fn in_units(&self, errors: &DVector<f64>) -> [f64; 2] {
        let noise = self.fitted.noise;
        let pose = |i: usize| std::array::from_fn(|c| errors[6 * i + c] * noise[c / 3]);
        rms(&(0..self.poses.len()).map(pose).collect::<Vec<_>>())
    }

    /// Terms and what they change of the physical model, both of which lie in the even quadratic, as its
    /// coefficients.
    fn coefficients(&self, chosen: &[Term]) -> [[f64; 6]; 10] {
        let (gram, right) = self.normal(&self.design(chosen));
        let count = right.len();
        let solved = Cholesky::new(gram).map_or(DVector::zeros(count), |c| c.solve(&right));
        let extra = |q: [f64; 4]| -> [f64; 6] {
            let (slopes, entries) = (slopes(&self.fitted.p, q), entries(q));
            std::array::from_fn(|c| {
                let physical: f64 = (0..N)
                    .map(|j| slopes[c][j] * self.size[j] * solved[j])
                    .sum();
                let own = chosen.iter().enumerate().filter(|(_, term)| term.0 == c);
                let terms: f64 = own.map(|(k, term)| solved[N + k] * entries[term.1]).sum();
                physical + terms * self.fitted.noise[c / 3]
            })
        };
        in_terms(extra)
    }
}

fn entries(q: [f64; 4]) -> [f64; 9] {
    let flat = of_quaternion(q);
    std::array::from_fn(|k| flat[k / 3][k % 3])
}

/// Squares of the errors, channel by channel.
fn squares(errors: &DVector<f64>) -> [f64; 6] {
    let mut sums = [0.0; 6];
    errors
        .iter()
        .enumerate()
        .for_each(|(row, e)| sums[row % 6] += e * e);
    sums
}

/// A function of the even quadratic as its coefficients: it is known at more orientations than it has terms.
fn in_terms(of: impl Fn([f64; 4]) -> [f64; 6]) -> [[f64; 6]; 10] {
    let mut normal = DMatrix::zeros(10, 10);
    let mut right = DMatrix::zeros(10, 6);
    for i in 0..60 {
        let [a, b, c] = [1.9, 0.7, 2.6].map(|step| step * f64::from(i));
        let q = quaternion(a, b, c);
        let row = DVector::from_row_slice(&terms(q));
        normal.ger(1.0, &row, &row, 1.0);
        right.ger(1.0, &row, &DVector::from_row_slice(&of(q)), 1.0);
    }
    let solved = Cholesky::new(normal).map_or(DMatrix::zeros(10, 6), |c| c.solve(&right));
    std::array::from_fn(|t| std::array::from_fn(|c| solved[(t, c)]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_entry_of_the_rotation_is_an_even_quadratic() {
        let of = |q: [f64; 4]| -> [f64; 6] { std::array::from_fn(|c| entries(q)[c + 3] - 0.3) };
        let coefficients = in_terms(of);
        for i in 0..20 {
            let q = quaternion(0.3 * f64::from(i), 1.1, -0.8 * f64::from(i));
            let found: [f64; 6] =
                std::array::from_fn(|c| (0..10).map(|t| terms(q)[t] * coefficients[t][c]).sum());
            for (a, b) in found.iter().zip(of(q)) {
                assert!((a - b).abs() < 1e-9, "{a} {b}");
            }
        }
    }
}
