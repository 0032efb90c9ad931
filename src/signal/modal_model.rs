//! The modal model of accelerances: poles, residues, and the terms of what lies outside the band.

use nalgebra::{DMatrix, DVector, QR};
use rustfft::num_complex::Complex64;

/// Powers of `s` with a real factor per channel beside the modes: rigid motion below the band, and the
/// series of the modes above it, even powers for their stiffness, odd ones for their damping.
pub const RESIDUALS: [i32; 7] = [0, 1, 2, 3, 4, 6, 8];

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

    /// What a pole `p` adds at line `k` per unit residue: the transform of its decay, `1/(s − p)`,
    /// less the samples after the end of the record, `e^{(p−s)τ}·Δt/(1 − e^{(p−s)Δt})`, with its
    /// derivative in `p`. So a short record does not bias the damping.
    fn decay(&self, pole: Complex64, k: usize) -> (Complex64, Complex64) {
        let x = pole - self.s(k);
        let sample = (x * self.interval_s).exp();
        let end = (x * self.decay_s).exp() * self.interval_s / (1.0 - sample);
        let slope = end * (self.decay_s + self.interval_s * sample / (1.0 - sample));
        (-1.0 / x - end, 1.0 / (x * x) - slope)
    }

    /// Columns of the linear unknowns, unweighted, per line: real and imaginary part of each residue,
    /// then the [`RESIDUALS`].
    pub fn basis(&self, poles: &[Complex64]) -> Vec<Vec<Complex64>> {
        let j = Complex64::i();
        let mut columns = Vec::new();
        for pole in poles {
            let pair = |k| (self.decay(*pole, k).0, self.decay(pole.conj(), k).0);
            let pairs: Vec<_> = (0..self.lines()).map(pair).collect();
            columns.push(pairs.iter().map(|(a, b)| a + b).collect());
            columns.push(pairs.iter().map(|(a, b)| j * (a - b)).collect());
        }
        let top = self.s(self.lines() - 1).norm();
        for power in RESIDUALS {
            let term = |k| (self.s(k) / top).powi(power);
            columns.push((0..self.lines()).map(term).collect());
        }
        columns
    }

    /// Derivatives of the two basis columns of a pole in its real and imaginary part:
    /// `[column][part][line]`.
    pub fn slopes(&self, pole: Complex64) -> [[Vec<Complex64>; 2]; 2] {
        let j = Complex64::i();
        let pair = |k| (self.decay(pole, k).1, self.decay(pole.conj(), k).1);
        let pairs: Vec<_> = (0..self.lines()).map(pair).collect();
        let all = |f: &dyn Fn(Complex64, Complex64) -> Complex64| -> Vec<Complex64> {
            pairs.iter().map(|(a, b)| f(*a, *b)).collect()
        };
        [
            [all(&|a, b| a + b), all(&|a, b| j * (a - b))],
            [all(&|a, b| j * (a - b)), all(&|a, b| -(a + b))],
        ]
    }
}

/// Weighted real and imaginary parts of a complex column, one above the other.
pub fn stacked(column: &[Complex64], weight: &[f64]) -> Vec<f64> {
    let re = column.iter().zip(weight).map(|(v, w)| v.re * w);
    let im = column.iter().zip(weight).map(|(v, w)| v.im * w);
    re.chain(im).collect()
}

/// The linear unknowns of one channel for given poles.
pub struct LinearFit {
    /// Orthonormal columns spanning the basis.
    pub q: DMatrix<f64>,
    /// Residue parts and residual terms.
    pub unknowns: DVector<f64>,
    /// What is left, weighted.
    pub rest: DVector<f64>,
}

/// Weighted least squares for the residues of channel `c` (least-squares frequency domain method).
/// None if the basis is singular.
pub fn linear_fit(channels: &Channels, basis: &[Vec<Complex64>], c: usize) -> Option<LinearFit> {
    let weight = &channels.weight[c];
    let columns: Vec<f64> = basis
        .iter()
        .flat_map(|column| stacked(column, weight))
        .collect();
    let rows = 2 * channels.lines();
    let matrix = DMatrix::from_vec(rows, basis.len(), columns);
    let target = DVector::from_vec(stacked(&channels.frf[c], weight));
    let scale: Vec<f64> = matrix
        .column_iter()
        .map(|column| column.norm().max(1e-300))
        .collect();
    let mut scaled = matrix;
    for (mut column, size) in scaled.column_iter_mut().zip(&scale) {
        column /= *size;
    }
    let (q, r) = QR::new(scaled).unpack();
    let projected = q.tr_mul(&target);
    let mut unknowns = r.solve_upper_triangular(&projected)?;
    let rest = target - &q * projected;
    unknowns
        .iter_mut()
        .zip(&scale)
        .for_each(|(u, size)| *u /= size);
    Some(LinearFit { q, unknowns, rest })
}

/// Frequency in Hz of a pole: `|p|/2π`.
pub fn frequency(pole: Complex64) -> f64 {
    pole.norm() / std::f64::consts::TAU
}

/// Damping ratio of a pole: `−Re p/|p|`.
pub fn damping(pole: Complex64) -> f64 {
    -pole.re / pole.norm()
}
