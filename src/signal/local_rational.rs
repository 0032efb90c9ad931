//! Noise of a frequency response without the records behind it: what a local rational model leaves
//! (McKelvey and Guérin, Non-parametric frequency response estimation using a local rational model,
//! IFAC Symposium on System Identification 2012).

use super::line_noise::correlation;
use nalgebra::{DMatrix, DVector};
use rustfft::num_complex::Complex64;

/// Half width of the window, lines.
const HALF: usize = 7;
/// Degree of numerator and denominator.
const DEGREE: usize = 2;
/// Least share of the noise that a window must leave to tell its size.
const LEAST: f64 = 0.02;

/// Variance `var(Re) + var(Im)` of the noise at every line of `frf`, on evenly spaced lines; not a number
/// where a window tells nothing. `x = σT` of the exponential window, which correlates neighbours: a model
/// that follows them leaves less, and that is counted.
pub fn variance(frf: &[Complex64], x: f64) -> Vec<f64> {
    let width = 2 * HALF + 1;
    if frf.len() < width {
        return vec![f64::NAN; frf.len()];
    }
    let noise = DMatrix::from_fn(width, width, |a, b| match x > 1e-6 {
        true => correlation(x, 0.0, a as f64 - b as f64),
        false => Complex64::from(f64::from(u8::from(a == b))),
    });
    let at = |k: usize| {
        let from = k.saturating_sub(HALF).min(frf.len() - width);
        around(&frf[from..from + width], &noise)
    };
    (0..frf.len()).map(at).collect()
}

/// The variance in one window: `H·(1 + d₁r + d₂r²) = a₀ + a₁r + a₂r²` by least squares.
fn around(window: &[Complex64], noise: &DMatrix<Complex64>) -> f64 {
    let size = window
        .iter()
        .fold(f64::MIN_POSITIVE, |m, h| m.max(h.norm()));
    let place = |i: usize| i as f64 / HALF as f64 - 1.0;
    let basis = DMatrix::from_fn(window.len(), 2 * DEGREE + 1, |i, j| match j <= DEGREE {
        true => Complex64::from(place(i).powi(j as i32)),
        false => -window[i] / size * place(i).powi((j - DEGREE) as i32),
    });
    let target = DVector::from_iterator(window.len(), window.iter().map(|h| h / size));
    let qr = basis.clone().qr();
    let (q, r) = (qr.q(), qr.r());
    let Some(amounts) = r.solve_upper_triangular(&(q.adjoint() * &target)) else {
        return f64::NAN;
    };
    let left = (&target - &basis * &amounts).norm_squared();
    let kept = noise.trace().re - (q.adjoint() * noise * &q).trace().re;
    let denominator = |i: usize| {
        let terms = (1..=DEGREE).map(|j| amounts[DEGREE + j] * place(i).powi(j as i32));
        terms
            .fold(Complex64::from(1.0), |sum, term| sum + term)
            .norm_sqr()
    };
    let gain = (0..window.len()).map(denominator).sum::<f64>() / window.len() as f64;
    match kept > LEAST * window.len() as f64 && gain > 0.0 {
        true => left / kept / gain * size * size,
        false => f64::NAN,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ground::random::Random;

    fn resonant(hz: f64) -> Complex64 {
        let s = Complex64::new(0.0, hz);
        let mode = |f: f64, d: f64| s * s / (s * s + 2.0 * d * f * s + f * f);
        mode(9.0, 0.03) + mode(17.0, 0.02) * 0.5
    }

    #[test]
    fn the_noise_of_a_resonant_response_is_found() {
        let mut random = Random::new(3);
        for (step, std) in [(0.1, 0.01), (0.25, 0.05)] {
            let mut noisy = |k: usize| {
                let noise = Complex64::new(random.normal(), random.normal());
                resonant(1.0 + step * k as f64) + noise * std
            };
            let frf: Vec<Complex64> = (0..160).map(&mut noisy).collect();
            let found = variance(&frf, 0.0);
            let mean = found.iter().sum::<f64>() / found.len() as f64;
            let ratio = mean / (2.0 * std * std);
            assert!((0.8..1.25).contains(&ratio), "{step} {std}: {ratio}");
        }
    }

    #[test]
    fn too_few_lines_tell_nothing() {
        let frf = vec![Complex64::from(1.0); 9];
        assert!(variance(&frf, 0.0).iter().all(|v| v.is_nan()));
    }
}
