//! Orthonormal cosine transform (DCT-II): nearly diagonalises stationary noise of any colour.

use rustfft::{Fft, FftPlanner, num_complex::Complex};
use std::sync::Arc;

/// A planned orthonormal DCT-II of fixed length.
pub struct Cosine {
    n: usize,
    fft: Arc<dyn Fft<f64>>,
    twiddle: Vec<Complex<f64>>,
}

impl Cosine {
    /// Plans a transform of length `n` (n > 0).
    pub fn new(n: usize) -> Self {
        let fft = FftPlanner::new().plan_fft_forward(n.max(1));
        let twiddle = (0..n)
            .map(|k| {
                let scale = if k == 0 { 1.0 } else { 2.0_f64.sqrt() } / (n as f64).sqrt();
                Complex::from_polar(scale, -std::f64::consts::PI * k as f64 / (2.0 * n as f64))
            })
            .collect();
        Self { n, fft, twiddle }
    }

    /// Length.
    pub fn len(&self) -> usize {
        self.n
    }

    /// True for length zero.
    pub fn is_empty(&self) -> bool {
        self.n == 0
    }

    /// Transforms `x` in place (Makhoul 1980: one FFT of the same length).
    pub fn transform(&self, x: &mut [f64]) {
        let n = self.n;
        let mut buffer = vec![Complex::new(0.0, 0.0); n];
        for (i, value) in x.iter().enumerate() {
            let slot = if i % 2 == 0 { i / 2 } else { n - 1 - i / 2 };
            buffer[slot].re = *value;
        }
        self.fft.process(&mut buffer);
        for ((out, z), w) in x.iter_mut().zip(&buffer).zip(&self.twiddle) {
            *out = z.re * w.re - z.im * w.im;
        }
    }

    /// Transforms two vectors with one FFT.
    pub fn transform_pair(&self, a: &mut [f64], b: &mut [f64]) {
        let n = self.n;
        let mut buffer = vec![Complex::new(0.0, 0.0); n];
        for (i, (re, im)) in a.iter().zip(b.iter()).enumerate() {
            let slot = if i % 2 == 0 { i / 2 } else { n - 1 - i / 2 };
            buffer[slot] = Complex::new(*re, *im);
        }
        self.fft.process(&mut buffer);
        for k in 0..n {
            let (z, m) = (buffer[k], buffer[(n - k) % n].conj());
            let (even, odd) = ((z + m) * 0.5, (z - m) * Complex::new(0.0, -0.5));
            let w = self.twiddle[k];
            a[k] = even.re * w.re - even.im * w.im;
            b[k] = odd.re * w.re - odd.im * w.im;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_orthonormal_and_pairs_agree() {
        for n in [1, 2, 7, 64, 101] {
            let plan = Cosine::new(n);
            let mut a: Vec<f64> = (0..n).map(|i| ((i * i) as f64 * 0.37).sin()).collect();
            let mut b: Vec<f64> = (0..n).map(|i| (i as f64 * 0.9).cos() + 0.2).collect();
            let (ea, mut a1, mut b1) = (a.iter().map(|v| v * v).sum::<f64>(), a.clone(), b.clone());
            plan.transform(&mut a1);
            plan.transform(&mut b1);
            plan.transform_pair(&mut a, &mut b);
            assert!((a.iter().map(|v| v * v).sum::<f64>() - ea).abs() < 1e-9);
            assert!(
                a.iter()
                    .zip(&a1)
                    .chain(b.iter().zip(&b1))
                    .all(|(x, y)| (x - y).abs() < 1e-10)
            );
        }
    }
}
