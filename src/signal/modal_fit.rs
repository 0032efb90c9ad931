//! Poles refined by weighted least squares on the FRFs; residues are eliminated (variable
//! projection, Golub and Pereyra 1973, with Kaufman's 1975 gradient).

use super::modal_model::{Channels, LinearFit, linear_fit, stacked};
use nalgebra::{DMatrix, DVector};
use rustfft::num_complex::Complex64;

/// Poles with what they leave unexplained.
#[derive(Debug, Clone, PartialEq)]
pub struct PoleFit {
    /// Poles, 1/s.
    pub poles: Vec<Complex64>,
    /// Weighted sum of squares of what is left.
    pub cost: f64,
}

/// Linear fits of all channels; none if a basis is singular.
pub fn linear_fits(channels: &Channels, poles: &[Complex64]) -> Option<Vec<LinearFit>> {
    let basis = channels.basis(poles);
    (0..channels.frf.len())
        .map(|c| linear_fit(channels, &basis, c))
        .collect()
}

/// Weighted sum of squares that these poles leave.
pub fn cost(channels: &Channels, poles: &[Complex64]) -> f64 {
    let fits = linear_fits(channels, poles);
    fits.map_or(f64::INFINITY, |fits| total(&fits))
}

fn total(fits: &[LinearFit]) -> f64 {
    fits.iter().map(|fit| fit.rest.norm_squared()).sum()
}

/// Levenberg-Marquardt over `ln(−Re p)` and `Im p` of every pole, from `start`.
pub fn refine(channels: &Channels, start: &[Complex64], steps: usize) -> PoleFit {
    let mut best = PoleFit {
        poles: start.to_vec(),
        cost: f64::INFINITY,
    };
    let Some(mut fits) = linear_fits(channels, start) else {
        return best;
    };
    best.cost = total(&fits);
    let mut brake = 1e-3;
    for _ in 0..steps {
        let (normal, slope) = gauss_newton(channels, &best.poles, &fits);
        let before = best.cost;
        while brake < 1e8 {
            let trial = stepped(&best.poles, &normal, &slope, brake);
            let found = trial.and_then(|poles| Some((linear_fits(channels, &poles)?, poles)));
            match found {
                Some((trial, poles)) if total(&trial) < best.cost => {
                    best = PoleFit {
                        poles,
                        cost: total(&trial),
                    };
                    fits = trial;
                    brake = (brake * 0.1).max(1e-9);
                    break;
                }
                _ => brake *= 10.0,
            }
        }
        if before - best.cost <= 1e-7 * before {
            break;
        }
    }
    best
}

/// `JᵀJ` and `Jᵀr` over all channels.
fn gauss_newton(
    channels: &Channels,
    poles: &[Complex64],
    fits: &[LinearFit],
) -> (DMatrix<f64>, DVector<f64>) {
    let n = 2 * poles.len();
    let slopes: Vec<_> = poles.iter().map(|pole| channels.slopes(*pole)).collect();
    let mut normal = DMatrix::zeros(n, n);
    let mut slope = DVector::zeros(n);
    for (c, fit) in fits.iter().enumerate() {
        let mut columns = Vec::with_capacity(n * fit.rest.len());
        for (r, [real, imaginary]) in slopes.iter().enumerate() {
            let (a, b) = (fit.unknowns[2 * r], fit.unknowns[2 * r + 1]);
            for (part, size) in [(0, poles[r].re), (1, 1.0)] {
                let sum = |(u, v): (&Complex64, &Complex64)| (u * a + v * b) * size;
                let column: Vec<_> = real[part].iter().zip(&imaginary[part]).map(sum).collect();
                columns.extend(stacked(&column, &channels.weight[c]));
            }
        }
        let mut jacobian = DMatrix::from_vec(fit.rest.len(), n, columns);
        let inside = fit.q.tr_mul(&jacobian);
        jacobian -= &fit.q * inside;
        normal += jacobian.tr_mul(&jacobian);
        slope += jacobian.tr_mul(&fit.rest);
    }
    (normal, slope)
}

/// Poles after one damped step; none if they leave the left half plane or the matrix is singular.
fn stepped(
    poles: &[Complex64],
    normal: &DMatrix<f64>,
    slope: &DVector<f64>,
    brake: f64,
) -> Option<Vec<Complex64>> {
    let mut damped = normal.clone();
    for i in 0..damped.nrows() {
        damped[(i, i)] = damped[(i, i)].max(1e-300) * (1.0 + brake);
    }
    let step = damped.cholesky()?.solve(slope);
    let moved = poles.iter().enumerate().map(|(r, pole)| {
        let decay = step[2 * r].clamp(-1.0, 1.0).exp();
        Complex64::new(pole.re * decay, pole.im + step[2 * r + 1])
    });
    let moved: Vec<Complex64> = moved.collect();
    moved
        .iter()
        .all(|p| p.im > 0.0 && p.is_finite())
        .then_some(moved)
}
