//! Levenberg-Marquardt (Moré 1978) over all cuts, whose normal equations are made side by side.

use super::CutData;
use super::layout::Layout;
use super::whitening::Whitening;
use crate::ground::products::gram;
use crate::ground::spatial::V3;
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

/// Where a descent ended.
#[derive(Debug, Clone)]
pub struct Optimum {
    /// Values, SI.
    pub p: Vec<f64>,
    /// Normal matrix in scaled unknowns, priors included.
    pub normal: DMatrix<f64>,
    /// What is left of each cut, N.
    pub residuals: Vec<Vec<V3>>,
}

/// The data, what is unknown, and the noise.
pub struct Descent<'a> {
    /// The cuts.
    pub cuts: &'a [CutData],
    /// The unknowns.
    pub layout: &'a Layout,
    /// The noise.
    pub whitening: &'a Whitening,
}

struct Linear {
    normal: DMatrix<f64>,
    gradient: DVector<f64>,
    chi2: f64,
    residuals: Vec<Vec<V3>>,
}

/// One cut in standard deviations of the noise: x of all samples, then y, then z.
pub struct Whitened {
    /// Which unknowns the columns belong to.
    pub places: Vec<usize>,
    /// Slopes in scaled unknowns.
    pub jacobian: DMatrix<f64>,
    /// What is left.
    pub left: DVector<f64>,
    /// What is left, N.
    residual: Vec<V3>,
}

struct OneCut {
    places: Vec<usize>,
    normal: DMatrix<f64>,
    gradient: DVector<f64>,
    chi2: f64,
    residual: Vec<V3>,
}

const MOST_STEPS: usize = 40;

impl Descent<'_> {
    /// Goes down from `start` until a step lowers the squares by less than this share of them.
    pub fn from(&self, start: &[f64], arrived: f64) -> Optimum {
        let mut p = start.to_vec();
        let mut at = self.linearise(&p);
        let mut damping = 1e-3;
        for _ in 0..MOST_STEPS {
            let Some(step) = damped(&at.normal, &at.gradient, damping) else {
                break;
            };
            let moved: Vec<f64> = (0..p.len())
                .map(|j| p[j] + step[j] * self.layout.unknowns[j].scale)
                .collect();
            let trial = self.linearise(&moved);
            if trial.chi2 < at.chi2 {
                let fall = (at.chi2 - trial.chi2) / at.chi2.max(f64::MIN_POSITIVE);
                (p, at) = (moved, trial);
                damping = (damping * 0.1).max(1e-12);
                if fall < arrived {
                    break;
                }
            } else {
                damping *= 8.0;
                if damping > 1e8 {
                    break;
                }
            }
        }
        Optimum {
            p,
            normal: at.normal,
            residuals: at.residuals,
        }
    }

    fn linearise(&self, p: &[f64]) -> Linear {
        let cuts: Vec<OneCut> = (0..self.cuts.len())
            .into_par_iter()
            .map(|i| self.one(i, p))
            .collect();
        let n = self.layout.len();
        let mut linear = Linear {
            normal: DMatrix::zeros(n, n),
            gradient: DVector::zeros(n),
            chi2: 0.0,
            residuals: Vec::with_capacity(cuts.len()),
        };
        cuts.into_iter().for_each(|cut| linear.add(cut));
        self.add_priors(p, &mut linear);
        linear
    }

    fn one(&self, i: usize, p: &[f64]) -> OneCut {
        let white = self.whitened(i, p);
        OneCut {
            places: white.places,
            normal: gram(&white.jacobian),
            gradient: white.jacobian.tr_mul(&white.left),
            chi2: white.left.norm_squared(),
            residual: white.residual,
        }
    }

    /// What is left of one cut and its slopes, in standard deviations of the noise.
    pub fn whitened(&self, i: usize, p: &[f64]) -> Whitened {
        let data = &self.cuts[i];
        let predicted = data.scene.predict(&self.layout.of_one(i, p));
        let left = |(m, f): (&V3, &V3)| std::array::from_fn(|k| m[k] - f[k]);
        let residual: Vec<V3> = data.force.iter().zip(&predicted.force).map(left).collect();
        let white = DVector::from_vec(self.whitening.apply(&residual));
        let used: Vec<(usize, usize)> = self.layout.of_cut[i]
            .iter()
            .enumerate()
            .filter_map(|(kind, place)| place.map(|place| (kind, place)))
            .collect();
        let mut jacobian = DMatrix::zeros(white.len(), used.len());
        for (column, (kind, place)) in used.iter().enumerate() {
            let mut slope = self.whitening.apply(&predicted.slopes[*kind]);
            let scale = self.layout.unknowns[*place].scale;
            slope.iter_mut().for_each(|s| *s *= scale);
            jacobian.column_mut(column).copy_from_slice(&slope);
        }
        Whitened {
            places: used.into_iter().map(|(_, place)| place).collect(),
            jacobian,
            left: white,
            residual,
        }
    }

    fn add_priors(&self, p: &[f64], linear: &mut Linear) {
        for (j, unknown) in self.layout.unknowns.iter().enumerate() {
            if let Some([mean, spread]) = unknown.prior {
                let (left, weight) = ((mean - p[j]) / spread, unknown.scale / spread);
                linear.chi2 += left * left;
                linear.normal[(j, j)] += weight * weight;
                linear.gradient[j] += weight * left;
            }
        }
    }
}

impl Linear {
    fn add(&mut self, cut: OneCut) {
        for (a, i) in cut.places.iter().enumerate() {
            self.gradient[*i] += cut.gradient[a];
            for (b, j) in cut.places.iter().enumerate() {
                self.normal[(*i, *j)] += cut.normal[(a, b)];
            }
        }
        self.chi2 += cut.chi2;
        self.residuals.push(cut.residual);
    }
}

fn damped(normal: &DMatrix<f64>, gradient: &DVector<f64>, damping: f64) -> Option<DVector<f64>> {
    let mut damped = normal.clone();
    for j in 0..damped.nrows() {
        damped[(j, j)] += damping * normal[(j, j)] + 1e-9;
    }
    Some(damped.cholesky()?.solve(gradient))
}
