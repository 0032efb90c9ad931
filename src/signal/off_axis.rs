//! The direction in which a hit really struck, told from its response.

use nalgebra::{DMatrix, DVector};
use rustfft::num_complex::Complex64;

/// An FRF of one input as `[output][line]`.
pub type Column = [Vec<Complex64>];

/// Angle, rad, between a hit and its stated direction: the hit's own FRF is the sum of the FRFs of
/// all directions, weighted with the cosines of the force. `own` is the FRF of the stated direction
/// from the *other* hits, `across` those of the other directions. None without a second output or a
/// second direction, or where the directions cannot be told apart. With its standard error, rad, from what
/// the sum leaves of the hit's FRF: where a direction answers weakly, noise looks like a force along it.
pub fn angle(hit: &Column, own: &Column, across: &[&Column]) -> Option<(f64, f64)> {
    if hit.len() < 2 || across.is_empty() {
        return None;
    }
    let columns: Vec<Vec<f64>> = std::iter::once(own)
        .chain(across.iter().copied())
        .map(flattened)
        .collect();
    let target = DVector::from_vec(flattened(hit));
    let basis = DMatrix::from_fn(target.len(), columns.len(), |i, j| columns[j][i]);
    if basis.is_empty() {
        return None;
    }
    let cosines = basis.clone().svd(true, true).solve(&target, 1e-6).ok()?;
    let sideways = cosines.iter().skip(1).map(|c| c * c).sum::<f64>().sqrt();
    let freedom = target.len().checked_sub(columns.len() + 1)? as f64;
    let variance = (&basis * &cosines - &target).norm_squared() / freedom;
    let spread = (basis.transpose() * basis).pseudo_inverse(1e-300).ok()?;
    let across: f64 = (1..columns.len()).map(|i| spread[(i, i)]).sum();
    let stderr = (variance * across).sqrt() / sideways.hypot(cosines[0]);
    Some((sideways.atan2(cosines[0]), stderr))
}

/// Real and imaginary parts of all outputs and lines, those that are numbers.
fn flattened(column: &Column) -> Vec<f64> {
    let lines = column.iter().flat_map(|output| output.iter().skip(1));
    lines.flat_map(|h| [h.re, h.im]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn recovers_a_known_angle() {
        let h = |a: f64, b: f64| -> Vec<Vec<Complex64>> {
            let row = |s: f64| {
                (0..9)
                    .map(|k| Complex64::new(s + k as f64, s * k as f64))
                    .collect()
            };
            vec![row(a), row(b)]
        };
        let (x, y) = (h(1.0, 0.2), h(0.2, -2.0));
        let mixed: Vec<Vec<Complex64>> = (0..2)
            .map(|o| (0..9).map(|k| 0.8 * x[o][k] + 0.6 * y[o][k]).collect())
            .collect();
        let (found, stderr) = angle(&mixed, &x, &[&y]).unwrap();
        assert!(stderr < 1e-9);
        assert!((found - 0.6f64.atan2(0.8)).abs() < 1e-9);
    }
}
