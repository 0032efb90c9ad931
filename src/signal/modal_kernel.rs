//! What a pole adds to an accelerance per unit residue, as records of finite length show it.

use super::modal_model::Channels;
use rustfft::num_complex::Complex64;

/// What does not depend on the poles, per line.
#[derive(Debug, Clone)]
pub struct Lines {
    /// `s`, 1/s.
    s: Vec<Complex64>,
    /// `e^{−sτ}` at the end of the record and `e^{−sΔt}` of one sample.
    turns: Vec<[Complex64; 2]>,
    /// `e^{−cs²}` per input.
    pulse: Vec<Vec<Complex64>>,
    /// Half the mean square duration `c` of the pulse per input, s².
    half_s2: Vec<f64>,
    decay_s: f64,
    interval_s: f64,
}

/// Columns of one pole and its conjugate, real parts above imaginary ones: of the real and imaginary
/// part of its residue, then of their derivatives in the pole.
pub type Columns = [Vec<f64>; 4];

/// Below this share the end of the record is not seen.
const SEEN: f64 = 1e-7;

impl Lines {
    /// The lines of `channels`.
    pub fn new(channels: &Channels) -> Self {
        let s: Vec<Complex64> = (0..channels.lines()).map(|k| channels.s(k)).collect();
        let turn = |s: &Complex64| {
            [
                (-s * channels.decay_s).exp(),
                (-s * channels.interval_s).exp(),
            ]
        };
        let half_s2: Vec<f64> = channels.pulse_s2.iter().map(|v| 0.5 * v).collect();
        let pulse = |c: &f64| s.iter().map(|s| (-s * s * *c).exp()).collect();
        Self {
            turns: s.iter().map(turn).collect(),
            pulse: half_s2.iter().map(pulse).collect(),
            half_s2,
            s,
            decay_s: channels.decay_s,
            interval_s: channels.interval_s,
        }
    }

    /// The columns of `pole` for hits of direction `input`.
    pub fn columns(&self, pole: Complex64, input: usize) -> Columns {
        let (upper, lower) = (self.one(pole, input), self.one(pole.conj(), input));
        let pairs = || upper.iter().zip(&lower);
        let sum = |which: usize| -> Vec<f64> {
            let re = pairs().map(|(a, b)| a[which].re + b[which].re);
            re.chain(pairs().map(|(a, b)| a[which].im + b[which].im))
                .collect()
        };
        let turned = |which: usize| -> Vec<f64> {
            let re = pairs().map(|(a, b)| b[which].im - a[which].im);
            re.chain(pairs().map(|(a, b)| a[which].re - b[which].re))
                .collect()
        };
        [sum(0), turned(0), sum(1), turned(1)]
    }

    /// Whether the response of `pole` is still there at the end of the record: only then do the
    /// directions differ, by their pulses.
    pub fn sees_end(&self, pole: Complex64) -> bool {
        (pole.re * self.decay_s).exp() * self.turns[0][0].norm() > SEEN
    }

    /// `s²/(p²(s − p))`, so that no modes but those of the structure are at zero or infinity, less
    /// the samples after the end of the record, `e^{(p−s)τ}·Δt/(1 − e^{(p−s)Δt})` times
    /// `F(p)/F(s) = e^{c(p²−s²)}` of the pulse about its middle, with the derivative in `p`.
    fn one(&self, pole: Complex64, input: usize) -> Vec<[Complex64; 2]> {
        let inverse = pole.inv();
        let square = inverse * inverse;
        let c = self.half_s2[input];
        let left = (pole * self.decay_s + pole * pole * c).exp() * self.interval_s;
        let sample = (pole * self.interval_s).exp();
        let seen = self.sees_end(pole);
        let at = |k: usize| {
            let s = self.s[k];
            let gap = (s - pole).inv();
            let value = gap + s * square + inverse;
            let slope = gap * gap - 2.0 * s * square * inverse - square;
            if !seen {
                return [value, slope];
            }
            let [end, turn] = self.turns[k];
            let turned = sample * turn;
            let rest = (1.0 - turned).inv();
            let tail = left * end * self.pulse[input][k] * rest;
            let steeper = self.decay_s + self.interval_s * turned * rest + 2.0 * c * pole;
            [value - tail, slope - tail * steeper]
        };
        (0..self.s.len()).map(at).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_slope_is_the_derivative() {
        let channels = Channels {
            frequency_hz: (1..40).map(f64::from).collect(),
            rate: 0.7,
            decay_s: 0.9,
            interval_s: 1e-3,
            shape: (1, 1),
            driven: None,
            pulse_s2: vec![2e-6],
            frf: vec![],
            weight: vec![],
        };
        let lines = Lines::new(&channels);
        let pole = Complex64::new(-2.0, 70.0);
        let step = 1e-5;
        let [low, mid, high] = [-step, 0.0, step].map(|d| lines.one(pole + d, 0));
        for k in 0..mid.len() {
            let numeric = (high[k][0] - low[k][0]) / (2.0 * step);
            assert!((numeric - mid[k][1]).norm() < 1e-6 * mid[k][1].norm().max(1e-3));
        }
    }
}
