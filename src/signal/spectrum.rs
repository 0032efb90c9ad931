//! Spectra of real records: the discrete Fourier transform, unscaled, lines 0 to N/2.

use realfft::{RealFftPlanner, RealToComplex};
use rustfft::num_complex::Complex64;
use std::sync::Arc;

/// Transforms real records of one length. Shared between threads by reference; the scratch space
/// belongs to the caller.
#[derive(Clone)]
pub struct Transform {
    plan: Arc<dyn RealToComplex<f64>>,
}

impl Transform {
    /// A transform for records of `samples` values.
    pub fn new(samples: usize) -> Self {
        let plan = RealFftPlanner::<f64>::new().plan_fft_forward(samples);
        Self { plan }
    }

    /// Number of lines that come out: N/2 + 1.
    pub fn lines(&self) -> usize {
        self.plan.complex_len()
    }

    /// Empty working space for [`Transform::process`].
    pub fn scratch(&self) -> Vec<Complex64> {
        self.plan.make_scratch_vec()
    }

    /// Spectrum `X[k] = Σ x[n] e^{-2πjkn/N}` of `record`, which is used up as working space.
    /// Lengths that do not fit leave `lines` untouched; the constructors of this floor fit them.
    pub fn process(&self, record: &mut [f64], lines: &mut [Complex64], scratch: &mut [Complex64]) {
        let done = self.plan.process_with_scratch(record, lines, scratch);
        debug_assert!(done.is_ok(), "buffer lengths follow from the transform");
    }

    /// The first `keep` lines of the spectrum of `record`.
    pub fn of(&self, mut record: Vec<f64>, keep: usize) -> Vec<Complex64> {
        let mut lines = self.plan.make_output_vec();
        self.process(&mut record, &mut lines, &mut self.scratch());
        lines.truncate(keep);
        lines
    }
}

/// The frequencies in Hz of the first `lines` lines of records of `samples` values taken every
/// `interval_s`.
pub fn frequencies(samples: usize, interval_s: f64, lines: usize) -> Vec<f64> {
    let length_s = samples as f64 * interval_s;
    (0..lines).map(|k| k as f64 / length_s).collect()
}

/// Number of lines from 0 Hz up to and including `to_hz`, at most those up to Nyquist.
pub fn lines_up_to(samples: usize, interval_s: f64, to_hz: Option<f64>) -> usize {
    let all = samples / 2 + 1;
    let Some(to_hz) = to_hz else { return all };
    let last = (to_hz * samples as f64 * interval_s * (1.0 + 1e-9)).floor();
    (last.max(0.0) as usize).saturating_add(1).min(all)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equals_the_defining_sum_for_even_and_odd_lengths() {
        for n in [10usize, 15] {
            let x: Vec<f64> = (0..n).map(|i| ((i * i) % 7) as f64 - 2.5).collect();
            let transform = Transform::new(n);
            let lines = transform.of(x.clone(), transform.lines());
            for (k, line) in lines.iter().enumerate() {
                let sum: Complex64 = (0..n)
                    .map(|i| {
                        let turn = -std::f64::consts::TAU * (k * i) as f64 / n as f64;
                        Complex64::from_polar(x[i], turn)
                    })
                    .sum();
                assert!((sum - line).norm() < 1e-12);
            }
        }
    }

    #[test]
    fn counts_lines_up_to_a_frequency() {
        assert_eq!(lines_up_to(100, 0.01, None), 51);
        assert_eq!(lines_up_to(100, 0.01, Some(20.0)), 21);
        assert_eq!(lines_up_to(100, 0.01, Some(1e9)), 51);
    }
}
