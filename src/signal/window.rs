//! Windows for impact records. None of them rescales the FRF: both channels carry the same one.

use super::pulse::Pulse;

/// An exponential window `e^{-σt}` counted from the first sample of the record.
///
/// Applied to force and response alike, the estimated FRF is `H(jω + σ)` (the shift theorem of the
/// Laplace transform): poles appear moved by −σ, which is undone by adding σ to them.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Exponential {
    /// Decay rate σ, 1/s; 0 is no window.
    pub rate: f64,
}

impl Exponential {
    /// The window that has fallen to `end` (0 to 1) at the end of a record of `length_s`:
    /// `σ = −ln(end)/T`.
    pub fn with_end(end: f64, length_s: f64) -> Self {
        Self {
            rate: -end.ln() / length_s,
        }
    }

    /// Sum of its squares over a record.
    pub fn power(&self, samples: usize, interval_s: f64) -> f64 {
        let square = |i: usize| (-2.0 * self.rate * i as f64 * interval_s).exp();
        (0..samples).map(square).sum()
    }

    /// How many lines of a record of `length_s` carry the information of one: `x·coth x` with
    /// `x = σT`, the equivalent noise bandwidth of the squared window.
    pub fn lines_per_independent_one(&self, length_s: f64) -> f64 {
        let x = self.rate * length_s;
        if x < 1e-6 { 1.0 } else { x / x.tanh() }
    }

    /// Multiplies `record` (samples every `interval_s`) by the window.
    pub fn apply(&self, record: &mut [f64], interval_s: f64) {
        if self.rate == 0.0 {
            return;
        }
        for (i, value) in record.iter_mut().enumerate() {
            *value *= (-self.rate * i as f64 * interval_s).exp();
        }
    }
}

/// A force window: 1 over the pulse, on either side a cosine flank to 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Force {
    /// First sample after the rising flank.
    pub start: usize,
    /// First sample of the falling flank.
    pub end: usize,
    /// Samples of a flank.
    pub flank: usize,
}

impl Force {
    /// The window that leaves `pulse` whole, feet and filter ringing included.
    pub fn around(pulse: &Pulse) -> Self {
        let foot = pulse.width() / 2 + 2;
        Self {
            start: pulse.start.saturating_sub(foot),
            end: pulse.end + foot,
            flank: pulse.width() + 8,
        }
    }

    /// The value at sample `i`.
    fn at(&self, i: usize) -> f64 {
        let outside = if i < self.start {
            self.start - i
        } else {
            (i + 1).saturating_sub(self.end)
        };
        let part = outside.saturating_sub(1) as f64 / self.flank.max(1) as f64;
        match part < 1.0 {
            true => 0.5 * (1.0 + (std::f64::consts::PI * part).cos()),
            false => 0.0,
        }
    }

    /// Multiplies `record` (offset already removed) by the window.
    pub fn apply(&self, record: &mut [f64]) {
        for (i, value) in record.iter_mut().enumerate() {
            *value *= self.at(i);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponential_reaches_its_end() {
        let window = Exponential::with_end(0.01, 4.0);
        let mut record = vec![1.0; 4001];
        window.apply(&mut record, 1e-3);
        assert!((record[4000] - 0.01).abs() < 1e-12 && record[0] == 1.0);
    }

    #[test]
    fn force_window_keeps_the_pulse() {
        let mut record = vec![1.0; 20];
        Force {
            start: 2,
            end: 5,
            flank: 4,
        }
        .apply(&mut record);
        assert_eq!(record[4], 1.0);
        assert_eq!(record[9], 0.0);
        assert!((record[7] - 0.5).abs() < 1e-12);
    }
}
