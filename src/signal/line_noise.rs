//! Noise of spectral lines under an exponential window, which correlates neighbours.

use rustfft::num_complex::Complex64;
use rustfft::{Fft, FftPlanner};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

/// Correlation of lines: white noise under `e^{−σt}` over a record of length T gives
/// `ρ(m) = 1/(1 + jπm/x)`, `x = σT`, for lines that are m apart, where time counts from the first
/// sample; from another instant the lines turn.
pub struct LineNoise {
    lines: usize,
    /// Transform of ρ laid on a circle.
    spectrum: Vec<Complex64>,
    plans: [Arc<dyn Fft<f64>>; 2],
}

impl LineNoise {
    /// For `lines` neighbouring lines, `x = σT` above 0, and time from `origin` times the length of the
    /// record.
    pub fn new(lines: usize, x: f64, origin: f64) -> Self {
        let size = (2 * lines).next_power_of_two();
        let mut spectrum = vec![Complex64::default(); size];
        for m in 0..lines {
            spectrum[m] = correlation(x, origin, m as f64);
            spectrum[(size - m) % size] = correlation(x, origin, -(m as f64));
        }
        let mut planner = FftPlanner::new();
        let plans = [
            planner.plan_fft_forward(size),
            planner.plan_fft_inverse(size),
        ];
        plans[0].process(&mut spectrum);
        Self {
            lines,
            spectrum,
            plans,
        }
    }

    /// The matrix of correlations times `column`.
    pub fn times(&self, column: impl Iterator<Item = Complex64>) -> Vec<Complex64> {
        let mut values: Vec<Complex64> = column.take(self.lines).collect();
        values.resize(self.spectrum.len(), Complex64::default());
        self.plans[0].process(&mut values);
        let scale = 1.0 / values.len() as f64;
        for (value, factor) in values.iter_mut().zip(&self.spectrum) {
            *value *= factor * scale;
        }
        self.plans[1].process(&mut values);
        values.truncate(self.lines);
        values
    }
}

/// Correlation of lines that are `apart`, as [`LineNoise`] describes it.
pub(super) fn correlation(x: f64, origin: f64, apart: f64) -> Complex64 {
    Complex64::cis(TAU * origin * apart) / Complex64::new(1.0, PI * apart / x)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ground::random::Random;
    use crate::signal::spectrum::Transform;
    use crate::signal::window::Exponential;

    #[test]
    fn a_product_is_that_of_the_matrix() {
        let noise = LineNoise::new(5, 2.0, 0.1);
        let column = |k: usize| Complex64::new(k as f64, 1.0 - k as f64);
        let product = noise.times((0..5).map(column));
        for (k, value) in product.iter().enumerate() {
            let apart = |l: usize| k as f64 - l as f64;
            let direct: Complex64 = (0..5)
                .map(|l| correlation(2.0, 0.1, apart(l)) * column(l))
                .sum();
            assert!((value - direct).norm() < 1e-12);
        }
    }

    #[test]
    fn windowed_noise_is_so_correlated() {
        let (samples, length_s) = (512, 2.0);
        let window = Exponential { rate: 1.5 };
        let (mut across, mut own) = (Complex64::default(), 0.0);
        let mut random = Random::new(5);
        for _ in 0..4000 {
            let mut record: Vec<f64> = (0..samples).map(|_| random.normal()).collect();
            window.apply(&mut record, length_s / samples as f64);
            let lines = Transform::new(samples).of(record, 30);
            across += lines[22] * lines[20].conj();
            own += lines[20].norm_sqr();
        }
        assert!((across / own - correlation(3.0, 0.0, 2.0)).norm() < 0.05);
    }
}
