//! What the physical model leaves over the orientation, as a polynomial of the quaternion (source 002, 2.6:
//! the pull of the hose). Source 002 takes all 15 terms of degree two; with |q| = 1 they have rank 14, and
//! only the ten of even degree have one value for q and −q, which are one orientation. So only those are
//! taken: one and the nine entries of R. Whether all are taken, and how strongly they are held to zero, or only
//! a few of them, or none, is chosen by orientations that were left out.

use super::fitted::{Fitted, System, rms};
use super::poses::Pose;
use super::sparse::Sparse;
use super::statics::{N, slopes};
use nalgebra::{DMatrix, DVector};

/// Terms qᵢ qⱼ with i ≤ j in the order w, x, y, z.
pub const TERMS: [(usize, usize); 10] = [
    (0, 0),
    (0, 1),
    (0, 2),
    (0, 3),
    (1, 1),
    (1, 2),
    (1, 3),
    (2, 2),
    (2, 3),
    (3, 3),
];

/// How the polynomial is meant.
pub const CONVENTION: &str = "load left = sum over terms of coefficient · qi · qj, with q = (w, x, y, z) the unit quaternion that turns sensor axes into base axes. \
The 15 terms of a full quadratic have rank 14, since |q| = 1: the constant is the sum of the squares. Only the ten even terms are kept, \
since q and −q are one orientation and odd terms would give them two values. Weight, offsets, tilt, turn, gains and cross-talk of the forces lie in the same space: \
they are taken out first, the polynomial holds the rest.";

/// The value of every term.
pub fn terms(q: [f64; 4]) -> [f64; 10] {
    TERMS.map(|(i, j)| q[i] * q[j])
}

/// The polynomial of what is left.
#[derive(Debug, Clone, PartialEq)]
pub struct Remainder {
    /// Coefficients, one row per term, six channels; all zero for order 0.
    pub coefficients: [[f64; 6]; 10],
    /// 0: nothing is gained by a polynomial; 2: even quadratic.
    pub order: usize,
    /// Root mean square left by the physical model: forces, N, and moments, N·m.
    pub before: [f64; 2],
    /// Left by both.
    pub after: [f64; 2],
    /// Left at orientations that were not fitted, with the chosen order.
    pub held_out: [f64; 2],
    /// The same with the physical model alone.
    pub held_out_before: [f64; 2],
}

/// Strengths that are tried: prior variance of a coefficient over the variance of the noise.
const STRENGTHS: [f64; 9] = [0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 100.0, 1e4, 1e8];
/// A polynomial must lower the held-out error at least to this share.
const WORTH: f64 = 0.97;
/// Fewer orientations than this say nothing about ten terms.
const FEWEST: usize = 8;

impl Remainder {
    /// Of the residuals of a fit.
    pub fn of(poses: &[Pose], fitted: &Fitted) -> Self {
        let before = fitted.rms();
        let scheme = Scheme::new(poses, fitted);
        let plain = scheme.held_out([0.0; 2]);
        let mut found = Self {
            coefficients: [[0.0; 6]; 10],
            order: 0,
            before,
            after: before,
            held_out: plain,
            held_out_before: plain,
        };
        if scheme.folds.len() < FEWEST {
            return found;
        }
        let tried: Vec<(f64, [f64; 2])> = STRENGTHS
            .iter()
            .map(|s| (*s, scheme.held_out([*s; 2])))
            .collect();
        let best = [0, 1].map(|kind| {
            let best = tried.iter().min_by(|a, b| a.1[kind].total_cmp(&b.1[kind]));
            best.filter(|b| b.1[kind] < WORTH * plain[kind])
                .map_or(0.0, |b| b.0)
        });
        if best != [0.0; 2] {
            found.order = 2;
            found.held_out = scheme.held_out(best);
            found.coefficients =
                scheme.coefficients(&fitted.residual, &vec![true; poses.len()], best);
        }
        if let Some(few) = Sparse::of(poses, fitted, &scheme.folds) {
            for kind in (0..2).filter(|k| few.held_out[*k] < WORTH * plain[*k]) {
                if few.held_out[kind] <= found.held_out[kind] {
                    found.take(kind, &few);
                }
            }
        }
        if found.order == 0 {
            return found;
        }
        let left = poses.iter().zip(&fitted.residual).map(|(pose, r)| {
            let more = found.at(pose.quaternion);
            std::array::from_fn(|c| r[c] - more[c])
        });
        found.after = rms(&left.collect::<Vec<_>>());
        found
    }

    /// Takes forces (0) or moments (1) from a remainder of few terms.
    fn take(&mut self, kind: usize, few: &Sparse) {
        self.order = 2;
        self.held_out[kind] = few.held_out[kind];
        for (own, other) in self.coefficients.iter_mut().zip(&few.coefficients) {
            own[3 * kind..3 * kind + 3].copy_from_slice(&other[3 * kind..3 * kind + 3]);
        }
    }

    /// Its value: forces, N, and moments, N·m.
    pub fn at(&self, q: [f64; 4]) -> [f64; 6] {
        let terms = terms(q);
        std::array::from_fn(|c| (0..10).map(|t| terms[t] * self.coefficients[t][c]).sum())
    }
}

/// Everything that is needed to leave orientations out.
struct Scheme<'a> {
    poses: &'a [Pose],
    fitted: &'a Fitted,
    slopes: Vec<[[f64; N]; 6]>,
    terms: Vec<[f64; 10]>,
    /// Poses of one orientation belong together.
    folds: Vec<Vec<usize>>,
}

/// Orientations whose quaternions agree to this are one.
const ONE: f64 = 1e-3;

impl<'a> Scheme<'a> {
    fn new(poses: &'a [Pose], fitted: &'a Fitted) -> Self {
        let mut folds: Vec<Vec<usize>> = Vec::new();
        for (i, pose) in poses.iter().enumerate() {
            let near = |fold: &&mut Vec<usize>| {
                let other = poses[fold[0]].quaternion;
                let along: f64 = other.iter().zip(&pose.quaternion).map(|(a, b)| a * b).sum();
                1.0 - along.abs() < ONE * ONE
            };
            match folds.iter_mut().find(near) {
                Some(fold) => fold.push(i),
                None => folds.push(vec![i]),
            }
        }
        Self {
            slopes: poses
                .iter()
                .map(|pose| slopes(&fitted.p, pose.quaternion))
                .collect(),
            terms: poses.iter().map(|pose| terms(pose.quaternion)).collect(),
            poses,
            fitted,
            folds,
        }
    }

    /// Error at orientations left out, physical model and polynomial fitted to the others.
    fn held_out(&self, strength: [f64; 2]) -> [f64; 2] {
        let mut errors = Vec::with_capacity(self.poses.len());
        for fold in &self.folds {
            let mut counts = vec![true; self.poses.len()];
            fold.iter().for_each(|i| counts[*i] = false);
            let change = self.physical(&counts);
            let residual: Vec<[f64; 6]> = (0..self.poses.len())
                .map(|i| self.moved(i, &change))
                .collect();
            let coefficients = self.coefficients(&residual, &counts, strength);
            for i in fold {
                let more = |c: usize| {
                    (0..10)
                        .map(|t| self.terms[*i][t] * coefficients[t][c])
                        .sum::<f64>()
                };
                errors.push(std::array::from_fn(|c| residual[*i][c] - more(c)));
            }
        }
        rms(&errors)
    }

    /// Residual of a pose after the parameters changed a little.
    fn moved(&self, i: usize, change: &DVector<f64>) -> [f64; 6] {
        std::array::from_fn(|c| {
            let moved: f64 = (0..N).map(|j| self.slopes[i][c][j] * change[j]).sum();
            self.fitted.residual[i][c] - moved
        })
    }

    /// Change of the physical parameters when only some poses count: one Gauss-Newton step.
    fn physical(&self, counts: &[bool]) -> DVector<f64> {
        let kept: Vec<Pose> = (0..counts.len())
            .filter(|i| counts[*i])
            .map(|i| self.poses[i])
            .collect();
        let fitted = self.fitted;
        let covariance = System::new(&kept, &fitted.prior, fitted.noise, &fitted.p).covariance();
        let mut gradient = DVector::from_fn(N, |j, _| -fitted.p[j] / fitted.prior[j].powi(2));
        for i in (0..counts.len()).filter(|i| counts[*i]) {
            for c in 0..6 {
                let weight = fitted.residual[i][c] / fitted.noise[c / 3].powi(2);
                (0..N).for_each(|j| gradient[j] += weight * self.slopes[i][c][j]);
            }
        }
        covariance * gradient
    }

    /// Coefficients of the polynomial through residuals that count, held to zero by a prior.
    fn coefficients(
        &self,
        residual: &[[f64; 6]],
        counts: &[bool],
        strength: [f64; 2],
    ) -> [[f64; 6]; 10] {
        let mut out = [[0.0; 6]; 10];
        let some = || (0..counts.len()).filter(|i| counts[*i]);
        for (kind, strength) in strength.into_iter().enumerate().filter(|s| s.1 > 0.0) {
            let mut normal = DMatrix::identity(10, 10) / strength;
            for i in some() {
                let row = DVector::from_row_slice(&self.terms[i]);
                normal.ger(1.0, &row, &row, 1.0);
            }
            let Some(factor) = normal.cholesky() else {
                continue;
            };
            for c in 3 * kind..3 * kind + 3 {
                let mut right = DVector::zeros(10);
                some().for_each(|i| {
                    (0..10).for_each(|t| right[t] += self.terms[i][t] * residual[i][c])
                });
                let solved = factor.solve(&right);
                (0..10).for_each(|t| out[t][c] = solved[t]);
            }
        }
        out
    }
}
