//! How far the model is wrong anyway, as the accelerance and the most probable set of causes have it.

use super::data::{Data, Pair};
use super::map::{Fit, unknowns};
use crate::ground::products::gram;
use crate::inference::doubt::largest_share;
use nalgebra::{DMatrix, DVector};

/// Least share: of a hundredth, as hits differ, and of 0.45 % that the model misses, a thousandth and half of that.
const LEAST: f64 = 0.125;

/// The largest share of the model's error that the lines do not contradict; `fits` were made at the whole of it.
pub fn doubt(data: &Data, fits: &[Fit]) -> f64 {
    let best = fits.iter().max_by(|a, b| a.evidence.total_cmp(&b.evidence));
    best.map_or(1.0, |fit| {
        largest_share(LEAST, |share| likelihood(data, fit, share))
    })
}

/// Logarithm of the likelihood of the lines about a fit, amounts and nuisances summed out along straight lines.
fn likelihood(data: &Data, fit: &Fit, share: f64) -> f64 {
    let other = data.doubting(share);
    let both = data.pairs.iter().zip(&other.pairs);
    let rises = both.flat_map(|(old, new): (&Pair, &Pair)| {
        let each = new.weight.iter().zip(&old.weight);
        each.flat_map(|(new, old)| [new / old; 2])
    });
    let rises = DVector::from_iterator(fit.residual.len(), rises);
    let density: f64 = rises.iter().map(|rise| rise.ln()).sum();
    let mut slopes = fit.slopes.clone();
    for mut column in slopes.column_iter_mut() {
        column.component_mul_assign(&rises);
    }
    let left = fit.residual.component_mul(&rises);
    let own = DVector::from_iterator(slopes.ncols(), unknowns(&fit.point));
    let normal = gram(&slopes) + DMatrix::identity(slopes.ncols(), slopes.ncols());
    let Some(root) = normal.cholesky() else {
        return f64::NEG_INFINITY;
    };
    let pull = slopes.tr_mul(&left) - &own;
    let cost = left.norm_squared() + own.norm_squared() - pull.dot(&root.solve(&pull));
    let spread: f64 = root.l_dirty().diagonal().iter().map(|d| d.ln()).sum();
    density / data.correlated - 0.5 * cost - spread
}
