//! The textbook's check: mean forces over whole revolutions against the closed forms of c sin φ.

use super::CutData;
use crate::cutting::LINEAR_EDGE;
use crate::cutting::mean::mean_basis;
use crate::ground::spatial::V3;
use nalgebra::{DMatrix, DVector};
use std::f64::consts::TAU;

/// Coefficients from mean forces.
#[derive(Debug, Clone, PartialEq)]
pub struct Averaged {
    /// Mean measured force of each cut over whole revolutions, N.
    pub means: Vec<V3>,
    /// Ktc .. Kae in the units of their names; `None` where the means do not fix it.
    pub coefficients: [Option<f64>; 6],
}

/// Information relative to the largest below which a combination counts as open.
const OPEN: f64 = 1e-8;

/// Mean forces and what follows from them.
pub fn averaged(cuts: &[CutData]) -> Averaged {
    let means: Vec<V3> = cuts.iter().map(mean).collect();
    let scale = scales(cuts);
    let rows = 3 * cuts.len();
    let (mut design, mut right) = (DMatrix::zeros(rows, 6), DVector::zeros(rows));
    for (i, cut) in cuts.iter().enumerate() {
        let tool = &cut.scene.tool;
        let basis = mean_basis(&cut.scene.cut, tool.radius_m, tool.teeth);
        for k in 0..3 {
            right[3 * i + k] = means[i][k];
            (0..6).for_each(|j| design[(3 * i + k, j)] = basis[j][k] * scale[j]);
        }
    }
    let eigen = design.tr_mul(&design).symmetric_eigen();
    let largest = eigen.eigenvalues.max().max(f64::MIN_POSITIVE);
    let gradient = design.tr_mul(&right);
    let mut solution = DVector::zeros(6);
    let mut open = [0.0; 6];
    for (value, vector) in eigen
        .eigenvalues
        .iter()
        .zip(eigen.eigenvectors.column_iter())
    {
        match *value > OPEN * largest {
            true => solution += vector * (vector.dot(&gradient) / value),
            false => (0..6).for_each(|j| open[j] += vector[j] * vector[j]),
        }
    }
    let card = LINEAR_EDGE.card();
    let of =
        |j: usize| (open[j] < 1e-6).then(|| solution[j] * scale[j] / card.coefficients[j].factor);
    Averaged {
        means,
        coefficients: std::array::from_fn(of),
    }
}

/// Sizes that make cutting and edge coefficients alike.
fn scales(cuts: &[CutData]) -> [f64; 6] {
    let feed = |c: &CutData| c.scene.cut.feed_per_tooth(c.scene.tool.teeth);
    let feed = cuts.iter().map(feed).sum::<f64>() / cuts.len().max(1) as f64;
    [1.0 / feed, 1.0 / feed, 1.0 / feed, 1.0, 1.0, 1.0]
}

fn mean(cut: &CutData) -> V3 {
    let period = TAU / cut.scene.cut.spindle_rad_s;
    let time = &cut.scene.time;
    let step = time.last().unwrap_or(&0.0) / (time.len().max(2) - 1) as f64;
    let whole = ((time.len() as f64 * step / period).floor() * period / step).round() as usize;
    let used = if whole == 0 {
        time.len()
    } else {
        whole.min(time.len())
    };
    let sum = |k: usize| cut.force[..used].iter().map(|f| f[k]).sum::<f64>();
    std::array::from_fn(|k| sum(k) / used as f64)
}
