//! The descent over all cuts, whose normal equations are made side by side.

use super::CutData;
use super::layout::Layout;
use super::whitening::Whitening;
use crate::ground::products::gram;
use crate::ground::spatial::V3;
use crate::inference::descent::{Landscape, Linear, Stop, descend};
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

/// Values, and what they leave.
pub struct At {
    p: Vec<f64>,
    linear: Linear,
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
        let at = descend(
            self,
            self.at(start.to_vec()),
            Stop::at_share(MOST_STEPS, arrived),
        );
        Optimum {
            p: at.p,
            normal: at.linear.normal,
            residuals: at.residuals,
        }
    }

    fn at(&self, p: Vec<f64>) -> At {
        let cuts: Vec<OneCut> = (0..self.cuts.len())
            .into_par_iter()
            .map(|i| self.one(i, &p))
            .collect();
        let n = self.layout.len();
        let mut at = At {
            p,
            linear: Linear {
                normal: DMatrix::zeros(n, n),
                slope: DVector::zeros(n),
            },
            chi2: 0.0,
            residuals: Vec::with_capacity(cuts.len()),
        };
        cuts.into_iter().for_each(|cut| at.add(cut));
        self.add_priors(&mut at);
        at
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
        let white = DVector::from_vec(self.whitening.apply(&residual, &data.counts));
        let used: Vec<(usize, usize)> = self.layout.of_cut[i]
            .iter()
            .enumerate()
            .filter_map(|(kind, place)| place.map(|place| (kind, place)))
            .collect();
        let mut jacobian = DMatrix::zeros(white.len(), used.len());
        for (column, (kind, place)) in used.iter().enumerate() {
            let mut slope = self.whitening.apply(&predicted.slopes[*kind], &data.counts);
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

    fn add_priors(&self, at: &mut At) {
        for (j, unknown) in self.layout.unknowns.iter().enumerate() {
            if let Some([mean, spread]) = unknown.prior {
                let (left, weight) = ((mean - at.p[j]) / spread, unknown.scale / spread);
                at.chi2 += left * left;
                at.linear.normal[(j, j)] += weight * weight;
                at.linear.slope[j] += weight * left;
            }
        }
    }
}

impl Landscape for Descent<'_> {
    type Place = At;

    fn height(&self, place: &At) -> f64 {
        place.chi2
    }

    fn linear(&self, place: &mut At) -> Option<Linear> {
        Some(place.linear.clone())
    }

    fn step(&self, from: &At, step: &DVector<f64>) -> Option<At> {
        let parts = from.p.iter().zip(step.iter()).zip(&self.layout.unknowns);
        Some(self.at(parts.map(|((v, d), u)| v + d * u.scale).collect()))
    }
}

impl At {
    fn add(&mut self, cut: OneCut) {
        for (a, i) in cut.places.iter().enumerate() {
            self.linear.slope[*i] += cut.gradient[a];
            for (b, j) in cut.places.iter().enumerate() {
                self.linear.normal[(*i, *j)] += cut.normal[(a, b)];
            }
        }
        self.chi2 += cut.chi2;
        self.residuals.push(cut.residual);
    }
}
