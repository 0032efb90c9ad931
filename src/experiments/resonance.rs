//! A dynamometer that rings: a resonance of the second order between the force and its reading.

use crate::signal::low_pass::second_order;
use rustfft::num_complex::Complex64;

/// A resonance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Resonance {
    /// Frequency, Hz, and damping ratio.
    pub at: [f64; 2],
    /// Whether it stands in the place of the low pass that is stated, not beside it.
    pub instead: bool,
}

/// A sensor that has it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Resonant {
    /// The resonance.
    pub resonance: Resonance,
    /// The axes that ring.
    pub axes: [bool; 3],
    /// Share of the force that passes it.
    pub share: f64,
}

impl Resonance {
    /// What it makes of a line at `line_hz`, Hz.
    pub fn magnified(&self, line_hz: f64) -> Complex64 {
        let [hz, damping] = self.at;
        second_order(line_hz, hz, damping)
    }
}

impl Resonant {
    /// What the sensor makes of a line on an axis where the low pass alone makes `low` of it.
    pub(super) fn through(&self, low: Complex64, line_hz: f64, axis: usize) -> Complex64 {
        self.beside(low, 1.0, line_hz, axis)
    }

    /// Slope of [`Resonant::through`] where that of the low pass is `low`.
    pub(super) fn slope(&self, low: Complex64, line_hz: f64, axis: usize) -> Complex64 {
        self.beside(low, 0.0, line_hz, axis)
    }

    /// `alone`: what stands before the resonance where no low pass does.
    fn beside(&self, low: Complex64, alone: f64, line_hz: f64, axis: usize) -> Complex64 {
        let before = match self.resonance.instead {
            true => alone.into(),
            false => low,
        };
        match self.axes[axis] {
            true => low + (before * self.resonance.magnified(line_hz) - low) * self.share,
            false => low,
        }
    }
}
