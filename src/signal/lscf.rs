//! Poles by the polyreference least-squares complex frequency method (Peeters, Van der Auweraer,
//! Guillaume and Leuridan 2004): `H(ω) = B(ω)·A(ω)⁻¹` with matrix polynomials in `z = e^{jωΔt}`, the
//! band spread over half the unit circle.

use super::modal_model::Channels;
use nalgebra::{DMatrix, Schur};
use rustfft::num_complex::Complex64;

/// The normal equations of all outputs, for the highest order; lower orders are their corners.
pub struct Lscf {
    inputs: usize,
    /// Sampling interval that puts the top of the band at Nyquist, s.
    interval_s: f64,
    rate: f64,
    outputs: Vec<Normal>,
}

/// `R = XᴴX`, `S = XᴴY`, `T = YᴴY` of one output, real parts.
struct Normal {
    r: DMatrix<f64>,
    s: DMatrix<f64>,
    t: DMatrix<f64>,
}

impl Lscf {
    /// Sets up orders up to `highest`.
    pub fn new(channels: &Channels, highest: usize) -> Self {
        let top = channels.frequency_hz[channels.lines() - 1];
        let interval_s = 0.5 / top;
        let turns: Vec<f64> = channels
            .frequency_hz
            .iter()
            .map(|f| std::f64::consts::TAU * f * interval_s)
            .collect();
        let outputs = (0..channels.shape.1).map(|o| Normal::new(channels, &turns, highest, o));
        Self {
            inputs: channels.shape.0,
            interval_s,
            rate: channels.rate,
            outputs: outputs.collect(),
        }
    }

    /// The stable poles of order `order`, upper half plane, corrected for the exponential window.
    /// The lowest coefficient is the identity, which makes the poles of noise unstable.
    pub fn poles(&self, order: usize) -> Vec<Complex64> {
        let Some(denominator) = self.denominator(order) else {
            return Vec::new();
        };
        let inverse_z = companion_eigenvalues(&denominator, order, self.inputs);
        let poles = inverse_z.into_iter().filter(|y| y.norm() > 1e-9).map(|y| {
            let shifted = -y.ln() / self.interval_s;
            (shifted.re, shifted + self.rate)
        });
        poles
            .filter(|(stable, pole)| *stable < 0.0 && pole.re < 0.0 && pole.im > 0.0)
            .map(|(_, pole)| pole)
            .collect()
    }

    /// `A₁ … Aₙ`, stacked, from the reduced normal equations.
    fn denominator(&self, order: usize) -> Option<DMatrix<f64>> {
        let size = (order + 1) * self.inputs;
        let mut reduced = DMatrix::zeros(size, size);
        for normal in &self.outputs {
            let r = normal.r.view((0, 0), (order + 1, order + 1)).into_owned();
            let s = normal.s.view((0, 0), (order + 1, size)).into_owned();
            let solved = r.cholesky()?.solve(&s);
            reduced += normal.t.view((0, 0), (size, size)) - s.tr_mul(&solved);
        }
        let n = self.inputs;
        let free = size - n;
        let left = reduced.view((n, n), (free, free)).into_owned();
        let right = -reduced.view((n, 0), (free, n)).into_owned();
        left.lu().solve(&right)
    }
}

impl Normal {
    fn new(channels: &Channels, turns: &[f64], order: usize, output: usize) -> Self {
        let (inputs, outputs) = channels.shape;
        let channel = |i: usize| i * outputs + output;
        let weight = |k: usize| {
            let sum: f64 = (0..inputs)
                .map(|i| channels.weight[channel(i)][k].powi(-2))
                .sum();
            (inputs as f64 / sum).sqrt()
        };
        let weights: Vec<f64> = (0..turns.len()).map(weight).collect();
        let x = |row: usize, power: usize| {
            let (k, imaginary) = (row / 2, row % 2 == 1);
            part(
                Complex64::from_polar(weights[k], turns[k] * power as f64),
                imaginary,
            )
        };
        let y = |row: usize, column: usize| {
            let (k, imaginary) = (row / 2, row % 2 == 1);
            let (power, i) = (column / inputs, column % inputs);
            let turn = Complex64::from_polar(weights[k], turns[k] * power as f64);
            part(-turn * channels.frf[channel(i)][k], imaginary)
        };
        let x = DMatrix::from_fn(2 * turns.len(), order + 1, x);
        let y = DMatrix::from_fn(2 * turns.len(), (order + 1) * inputs, y);
        Self {
            r: x.tr_mul(&x),
            s: x.tr_mul(&y),
            t: y.tr_mul(&y),
        }
    }
}

fn part(value: Complex64, imaginary: bool) -> f64 {
    if imaginary { value.im } else { value.re }
}

/// Roots `y = 1/z` of `yⁿ·I + yⁿ⁻¹·A₁ + … + Aₙ`.
fn companion_eigenvalues(
    coefficients: &DMatrix<f64>,
    order: usize,
    inputs: usize,
) -> Vec<Complex64> {
    let size = order * inputs;
    let entry = |row: usize, column: usize| {
        if row < inputs {
            let (power, i) = (column / inputs, column % inputs);
            -coefficients[(power * inputs + row, i)]
        } else {
            f64::from(u8::from(row == column + inputs))
        }
    };
    let companion = DMatrix::from_fn(size, size, entry);
    if companion.iter().any(|v| !v.is_finite()) {
        return Vec::new();
    }
    let schur = Schur::try_new(companion, f64::EPSILON, 100 * size);
    let values = schur.map(|schur| schur.complex_eigenvalues());
    values.map_or(Vec::new(), |values| {
        values.iter().map(|v| Complex64::new(v.re, v.im)).collect()
    })
}
