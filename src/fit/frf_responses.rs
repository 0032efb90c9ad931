//! The model of a hammer test solved on some lines, as hammer and sensor read it.

use super::frf_data::Measured;
use crate::motion::Linear;
use crate::motion::frf::{C64, Response};
use crate::motion::uncertain::instrument::Reading;
use rustfft::num_complex::Complex64;

/// The model solved on some lines: one solution serves every pair measured on them.
pub struct Responses {
    pub(super) linear: Linear,
    pub(super) s: Vec<C64>,
    /// `Z⁻¹Jᵀ`, line by line.
    pub(super) answers: Vec<[C64; 3]>,
    /// The accelerance itself, the acceleration under moments, and what the instruments make of them.
    pub(super) bare: Vec<[Response; 2]>,
    pub(super) reading: Reading,
}

impl Responses {
    /// The accelerance along the directions of `pair`, as it is read.
    pub fn of(&self, pair: &Measured) -> Vec<Complex64> {
        let lines = self.bare.iter().zip(&self.s);
        lines
            .map(|([a, b], s)| self.reading.read_all(*s, [a, b])[pair.output][pair.input])
            .collect()
    }

    pub(super) fn at(&self, line: usize) -> &[[C64; 3]] {
        &self.answers[line * self.linear.n..(line + 1) * self.linear.n]
    }

    /// The same lines with something else in place of the accelerance, as read.
    pub(super) fn read(&self, lines: impl Iterator<Item = Response>) -> Vec<Response> {
        let lines = lines.zip(&self.s);
        lines.map(|(a, s)| self.reading.read(*s, &a)).collect()
    }
}

/// The entries of `pair` in responses.
pub fn along(pair: &Measured, lines: &[Response]) -> Vec<Complex64> {
    lines.iter().map(|a| a[pair.output][pair.input]).collect()
}
