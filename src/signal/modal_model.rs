//! FRFs on common lines with their weights, and what the poles of a modal model mean.

use rustfft::num_complex::Complex64;

/// FRFs of all inputs and outputs on common lines.
#[derive(Debug, Clone, PartialEq)]
pub struct Channels {
    /// Frequencies of the lines, Hz.
    pub frequency_hz: Vec<f64>,
    /// Rate σ of the exponential window, 1/s: the FRFs are `H(jω + σ)`.
    pub rate: f64,
    /// Time from the impulse to the end of the records, s.
    pub decay_s: f64,
    /// Time between samples, s.
    pub interval_s: f64,
    /// Number of inputs and of outputs.
    pub shape: (usize, usize),
    /// For each input the output that measures the same motion; none if one has no such output, or
    /// the numbers differ.
    pub driven: Option<Vec<usize>>,
    /// Mean square duration of the pulses about their middle per input, s².
    pub pulse_s2: Vec<f64>,
    /// `frf[input · outputs + output][line]`, (m/s²)/N.
    pub frf: Vec<Vec<Complex64>>,
    /// One over the standard deviation of each value.
    pub weight: Vec<Vec<f64>>,
}

impl Channels {
    /// `s = jω + σ` at line `k`, 1/s.
    pub fn s(&self, k: usize) -> Complex64 {
        Complex64::new(self.rate, std::f64::consts::TAU * self.frequency_hz[k])
    }

    /// Number of lines.
    pub fn lines(&self) -> usize {
        self.frequency_hz.len()
    }

    /// Highest circular frequency, 1/s.
    pub fn top(&self) -> f64 {
        std::f64::consts::TAU * self.frequency_hz[self.lines() - 1]
    }
}

/// Weighted real and imaginary parts of a complex column, one above the other.
pub fn stacked(column: &[Complex64], weight: &[f64]) -> Vec<f64> {
    let re = column.iter().zip(weight).map(|(v, w)| v.re * w);
    let im = column.iter().zip(weight).map(|(v, w)| v.im * w);
    re.chain(im).collect()
}

/// Frequency in Hz of a pole: `|p|/2π`.
pub fn frequency(pole: Complex64) -> f64 {
    pole.norm() / std::f64::consts::TAU
}

/// Damping ratio of a pole: `−Re p/|p|`.
pub fn damping(pole: Complex64) -> f64 {
    -pole.re / pole.norm()
}
