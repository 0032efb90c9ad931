//! Places for one more mode: a grid of poles, and what each would explain of the rest.

use super::modal_fit::Task;
use super::modal_search::near;
use super::modal_structure::Structure;
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;
use rustfft::num_complex::Complex64;

/// Ratio of neighbouring frequencies.
const RATIO: f64 = 1.05;
/// Damping ratios.
const DAMPING: [f64; 3] = [0.02, 0.06, 0.15];
/// Ends of the grid against the first and the last line.
const REACH: [f64; 2] = [1.0, 2.0];

/// Poles with their columns per channel.
pub struct Grid {
    places: Vec<Place>,
}

struct Place {
    pole: Complex64,
    /// Columns, and the inverse of their products, per channel.
    channels: Vec<(DMatrix<f64>, DMatrix<f64>)>,
}

impl Grid {
    /// The grid for `task`.
    pub fn new(task: &Task) -> Self {
        let low = task.channels.s(0).im * REACH[0];
        let high = task.channels.top() * REACH[1];
        let count = ((high / low).ln() / RATIO.ln()).ceil() as usize;
        let pole = |k: usize| {
            let w = low * RATIO.powi(k as i32);
            DAMPING.map(|d| Complex64::new(-d * w, w * (1.0 - d * d).sqrt()))
        };
        let poles: Vec<Complex64> = (0..=count).flat_map(pole).collect();
        let place = |pole: &Complex64| {
            let of_poles = task.columns(&[*pole]);
            let channel = |c: usize| {
                let columns = task.basis(c, &of_poles, false);
                let inverse = columns.tr_mul(&columns).try_inverse();
                (columns, inverse.unwrap_or_else(|| DMatrix::zeros(2, 2)))
            };
            Place {
                pole: *pole,
                channels: (0..task.target.len()).map(channel).collect(),
            }
        };
        Self {
            places: poles.par_iter().map(place).collect(),
        }
    }

    /// The poles that explain most of `rest`, far from each other, with their residues.
    pub fn best(
        &self,
        structure: &Structure,
        rest: &[DVector<f64>],
        count: usize,
    ) -> Vec<(Complex64, Vec<Complex64>)> {
        let gain = |place: &Place| place.gain(structure, rest);
        let gains: Vec<(f64, Vec<Complex64>)> = self.places.iter().map(gain).collect();
        let mut order: Vec<usize> = (0..gains.len()).collect();
        order.sort_by(|a, b| gains[*b].0.total_cmp(&gains[*a].0));
        let mut best: Vec<(Complex64, Vec<Complex64>)> = Vec::new();
        for k in order {
            let pole = self.places[k].pole;
            if best.len() < count && best.iter().all(|(other, _)| !near(pole, *other)) {
                best.push((pole, gains[k].1.clone()));
            }
        }
        best
    }
}

impl Place {
    /// What a mode here with a residue of rank one explains, and its free residue.
    fn gain(&self, structure: &Structure, rest: &[DVector<f64>]) -> (f64, Vec<Complex64>) {
        let slopes = self
            .channels
            .iter()
            .zip(rest)
            .map(|((columns, inverse), rest)| {
                let slope = columns.tr_mul(rest);
                let free = inverse * &slope;
                (slope, Complex64::new(free[0], free[1]))
            });
        let (slopes, residue): (Vec<DVector<f64>>, Vec<Complex64>) = slopes.unzip();
        let one = Structure {
            poles: vec![self.pole],
            shapes: vec![structure.shape(&residue)],
            ..structure.clone()
        };
        let (mut along, mut square) = (0.0, 0.0);
        for (c, (columns, _)) in self.channels.iter().enumerate() {
            let value = one.residue(0, c);
            let value = DVector::from_vec(vec![value.re, value.im]);
            along += value.dot(&slopes[c]);
            square += (columns * value).norm_squared();
        }
        (along.max(0.0).powi(2) / square.max(1e-300), residue)
    }
}
