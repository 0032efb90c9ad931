//! A measured accelerance as data of a tuning.

use crate::signal::modal_model::stacked;
use crate::signal::window::Exponential;
use nalgebra::DVector;
use rustfft::num_complex::Complex64;

/// One measured accelerance.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// Row of the Jacobian along which the force acts.
    pub input: usize,
    /// Row along which the acceleration is taken.
    pub output: usize,
    /// Frequencies, Hz.
    pub frequency_hz: Vec<f64>,
    /// Rate σ of the exponential window, 1/s: the model is evaluated at `jω + σ`.
    pub rate: f64,
    /// Length of the records, s (the window correlates neighbouring lines).
    pub length_s: f64,
    /// Accelerance, (m/s²)/N.
    pub frf: Vec<Complex64>,
    /// Variance of each value, `var(Re) + var(Im)`, the square of its unit.
    pub variance: Vec<f64>,
    /// What else is known of its errors.
    pub errors: Errors,
}

/// Errors of a measured accelerance beyond the variance of single lines.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Errors {
    /// Instant of the impulse from the start of the records, s.
    pub impulse_s: f64,
    /// Errors of the force that lines share, relative to it, one standard deviation each; empty where
    /// there are none.
    pub shared: Vec<Vec<Complex64>>,
    /// The accelerance with each of the hits left out; empty where there is one hit.
    pub left_out: Vec<Vec<Complex64>>,
}

impl Measured {
    /// `s = jω + σ` at line `k`.
    pub fn s(&self, k: usize) -> Complex64 {
        Complex64::new(self.rate, std::f64::consts::TAU * self.frequency_hz[k])
    }

    /// Whether `other` stands on the same lines, so that the model is the same there.
    pub fn on_lines_of(&self, other: &Self) -> bool {
        self.rate == other.rate && self.frequency_hz == other.frequency_hz
    }

    /// How many lines carry the information of one.
    pub fn lines_per_independent_one(&self) -> f64 {
        Exponential { rate: self.rate }.lines_per_independent_one(self.length_s)
    }

    /// One over the standard deviation of real and imaginary part, each line counted for its share.
    pub fn weight(&self) -> Vec<f64> {
        let independent = self.lines_per_independent_one();
        let weight = |v: &f64| (2.0 / (v * independent)).sqrt();
        self.variance.iter().map(weight).collect()
    }

    /// What a relative error of the force does to the weighted accelerance: real parts, then
    /// imaginary parts.
    pub fn weighted_error(&self, relative: &[Complex64]) -> DVector<f64> {
        let moved: Vec<Complex64> = self.frf.iter().zip(relative).map(|(h, e)| h * e).collect();
        DVector::from_vec(stacked(&moved, &self.weight()))
    }

    /// How the weighted accelerance moves to `other`: real parts, then imaginary parts.
    pub fn weighted_change(&self, other: &[Complex64]) -> DVector<f64> {
        let moved: Vec<Complex64> = other.iter().zip(&self.frf).map(|(a, b)| a - b).collect();
        DVector::from_vec(stacked(&moved, &self.weight()))
    }
}
