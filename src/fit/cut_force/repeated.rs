//! What the law leaves repeats with every tooth: unlike noise it does not average out over a long record.
//!
//! Scores are summed over all samples of a cut at the same place of a tooth passing before they are squared
//! (Liang and Zeger 1986): where they scatter more than noise does, intervals widen in that proportion.

use super::descent::Descent;
use super::layout::Layout;
use nalgebra::DMatrix;
use rayon::prelude::*;

/// Places of a tooth passing that are told apart.
const PLACES: usize = 24;

/// The covariance (SI) with intervals widened to what the scores of the cuts scatter by at `p`.
pub fn widened(covariance: DMatrix<f64>, descent: &Descent, p: &[f64]) -> DMatrix<f64> {
    let scatter = &covariance * squared(descent, p) * &covariance;
    let ratio = |j: usize| scatter[(j, j)] / covariance[(j, j)].max(f64::MIN_POSITIVE);
    let wider: Vec<f64> = (0..p.len()).map(|j| ratio(j).max(1.0).sqrt()).collect();
    DMatrix::from_fn(p.len(), p.len(), |i, j| {
        covariance[(i, j)] * wider[i] * wider[j]
    })
}

/// Sum of the squares of all scores, per SI.
fn squared(descent: &Descent, p: &[f64]) -> DMatrix<f64> {
    let layout = descent.layout;
    let of = |i: usize| of_cut(descent, i, p);
    let cuts: Vec<DMatrix<f64>> = (0..descent.cuts.len()).into_par_iter().map(of).collect();
    let mut sum = known_beforehand(layout);
    cuts.iter().for_each(|cut| sum += cut);
    sum
}

fn known_beforehand(layout: &Layout) -> DMatrix<f64> {
    let weight = |j: usize| {
        layout.unknowns[j]
            .prior
            .map_or(0.0, |[_, spread]| 1.0 / (spread * spread))
    };
    DMatrix::from_fn(layout.len(), layout.len(), |i, j| {
        if i == j { weight(i) } else { 0.0 }
    })
}

fn of_cut(descent: &Descent, i: usize, p: &[f64]) -> DMatrix<f64> {
    let (layout, scene) = (descent.layout, &descent.cuts[i].scene);
    let white = descent.whitened(i, p);
    let pitch = scene.tool.pitch_rad();
    let angles = scene.angles(&layout.of_one(i, p));
    let place =
        |angle: &f64| ((angle.rem_euclid(pitch) / pitch * PLACES as f64) as usize).min(PLACES - 1);
    let places: Vec<usize> = angles.iter().map(place).collect();
    let mut scores = DMatrix::<f64>::zeros(layout.len(), PLACES);
    for (column, unknown) in white.places.iter().enumerate() {
        let scale = layout.unknowns[*unknown].scale;
        for (row, left) in white.left.iter().enumerate() {
            let at = places[row % places.len()];
            scores[(*unknown, at)] += white.jacobian[(row, column)] * left / scale;
        }
    }
    &scores * scores.transpose()
}
