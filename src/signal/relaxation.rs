//! Noise whose power rises towards low frequencies: white noise beside relaxations of many time constants, which together make
//! 1/f between the slowest and the fastest (van der Ziel 1950). A relaxation forgets with time, so readings need not be evenly
//! spaced and records may have gaps.

mod whitening;

use whitening::Step;
pub use whitening::Whitening;

/// A noise of variance one, as far as its slowest relaxation was seen.
#[derive(Debug, Clone, PartialEq)]
pub struct Relaxations {
    /// Variance of its white part.
    white: f64,
    /// Rate of forgetting (1/s) and variance of every relaxation.
    each: Vec<[f64; 2]>,
    /// Slowest rate that was looked for; none: it was not estimated.
    slowest: Option<f64>,
}

/// Power in a band of frequencies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Band {
    /// Its frequency, Hz.
    pub hz: f64,
    /// Typical power there: one everywhere for white noise of variance one.
    pub power: f64,
    /// Independent lines that it stands for.
    pub lines: f64,
}

/// Ratio of neighbouring time constants: closer ones are one (a decade is three of them).
const RATIO: f64 = 2.2;
/// Rounds in which the variances are improved: each brings them closer, and none away (Févotte and Idier 2011).
const ROUNDS: usize = 300;
/// Steps of a decade.
const DECADE: f64 = 3.0;
/// Share of the variance below which a relaxation is none.
const NONE: f64 = 1e-3;
/// Nats by which bands must prefer a coloured noise to a white one: to take white noise for a little coloured costs little, to take
/// slow noise for a cause costs a wrong name.
const PREFERRED: f64 = 3.0;
/// Times the power at the highest frequency from which noise is called higher, and coloured.
const HIGHER: f64 = 2.0;

impl Relaxations {
    /// The colour of bands of readings a step (s) apart, by the likelihood of exponentially distributed powers (Whittle 1953);
    /// `None`: white. With it goes the variance of one reading, in the unit of the powers.
    pub fn of(bands: &[Band], step_s: f64) -> Option<(Self, f64)> {
        let [low, high] = [bands.first()?.hz, 0.25 / step_s];
        let steps = ((high / low).ln() / RATIO.ln()).floor().max(0.0) as usize;
        let rates = (0..=steps).map(|k| std::f64::consts::TAU * low * RATIO.powi(k as i32));
        let rates: Vec<f64> = rates.collect();
        let mut shapes = vec![vec![1.0; bands.len()]];
        let shape = |rate: &f64| {
            bands
                .iter()
                .map(|b| relaxing(*rate, b.hz, step_s))
                .collect()
        };
        shapes.extend(rates.iter().map(shape));
        let white = mean_power(bands);
        let variances = fitted(bands, &shapes, white);
        let gained = unlikely(bands, |_| white) - unlikely(bands, |b| sum(&variances, &shapes, b));
        let total: f64 = variances.iter().sum();
        let each = rates
            .iter()
            .zip(&variances[1..])
            .map(|(r, v)| [*r, v / total]);
        let each: Vec<[f64; 2]> = each.filter(|e| e[1] > NONE).collect();
        let relaxing: f64 = each.iter().map(|e| e[1]).sum();
        let found = Self {
            white: 1.0 - relaxing,
            each,
            slowest: rates.first().copied(),
        };
        let rises = found.power(low, step_s) > HIGHER * found.power(0.5 / step_s, step_s);
        (gained > PREFERRED && rises).then_some((found, total))
    }

    /// White noise.
    pub fn white() -> Self {
        Self {
            white: 1.0,
            each: Vec::new(),
            slowest: None,
        }
    }

    /// Whether it has no colour.
    pub fn is_white(&self) -> bool {
        self.each.is_empty()
    }

    /// The same going on as it rises until a time (s): bands begin where the records that they were taken from end, and nobody
    /// has seen a noise of 1/f end.
    #[must_use]
    pub fn slower(mut self, until_s: f64) -> Self {
        let Some(slowest) = self.slowest.filter(|_| until_s > 0.0) else {
            return self;
        };
        let steps = ((slowest * until_s).ln() / RATIO.ln()).floor().max(0.0) as i32;
        let near = self
            .each
            .iter()
            .filter(|e| e[0] < slowest * RATIO.powf(DECADE - 0.5));
        let variance = near.map(|e| e[1]).sum::<f64>() / DECADE;
        let more = (1..=steps).map(|k| [slowest / RATIO.powi(k), variance]);
        self.each.extend(more.filter(|e| e[1] > NONE));
        self
    }

    /// Power at a frequency (Hz) of readings a step (s) apart, one in the mean over all that it was estimated from.
    pub fn power(&self, hz: f64, step_s: f64) -> f64 {
        let each = self.each.iter();
        self.white
            + each
                .map(|[rate, v]| v * relaxing(*rate, hz, step_s))
                .sum::<f64>()
    }

    /// Variance of the second differences of readings a step (s) apart, over that of white noise of the same size.
    pub fn rough(&self, step_s: f64) -> f64 {
        let one = |[rate, v]: &[f64; 2]| {
            let kept = (-rate * step_s).exp();
            v * (6.0 - 8.0 * kept + 2.0 * kept * kept) / 6.0
        };
        self.white + self.each.iter().map(one).sum::<f64>()
    }

    /// Frequency below which it is higher than at the highest, Hz, for readings a step (s) apart.
    pub fn corner_hz(&self, step_s: f64) -> f64 {
        let least = HIGHER * self.power(0.5 / step_s, step_s);
        let (mut low, mut high) = (0.0, 0.5 / step_s);
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            match self.power(middle, step_s) > least {
                true => low = middle,
                false => high = middle,
            }
        }
        low
    }

    /// The filter that whitens readings at these times, s; a time that goes back begins anew.
    pub fn whitening(&self, times: &[f64]) -> Whitening {
        let count = self.each.len();
        let mut known = vec![vec![0.0; count]; count];
        (0..count).for_each(|k| known[k][k] = self.each[k][1]);
        let mut before = None;
        let step = |time: &f64| {
            let passed = before.map(|b| time - b).filter(|p| *p > 0.0);
            before = Some(*time);
            self.stepped(&mut known, passed.unwrap_or(f64::INFINITY))
        };
        Whitening::new(times.iter().map(step).collect())
    }

    /// One reading of the filter (Kalman 1960): `known` is the covariance of the relaxations before and after.
    fn stepped(&self, known: &mut [Vec<f64>], passed_s: f64) -> Step {
        let kept: Vec<f64> = self.each.iter().map(|e| (-e[0] * passed_s).exp()).collect();
        for (i, row) in known.iter_mut().enumerate() {
            row.iter_mut()
                .zip(&kept)
                .for_each(|(p, k)| *p *= k * kept[i]);
            row[i] += self.each[i][1] * (1.0 - kept[i] * kept[i]);
        }
        let seen: Vec<f64> = known.iter().map(|row| row.iter().sum()).collect();
        let variance = (self.white + seen.iter().sum::<f64>()).max(f64::MIN_POSITIVE);
        for (i, row) in known.iter_mut().enumerate() {
            let each = row.iter_mut().zip(&seen);
            each.for_each(|(p, s)| *p -= seen[i] * s / variance);
        }
        Step {
            kept,
            gain: seen.iter().map(|s| s / variance).collect(),
            over: variance.sqrt().recip(),
        }
    }
}

/// Power of a relaxation of variance one, one in the mean over all frequencies.
fn relaxing(rate: f64, hz: f64, step_s: f64) -> f64 {
    let kept = (-rate * step_s).exp();
    let turn = (std::f64::consts::TAU * hz * step_s).cos();
    (1.0 - kept * kept) / (1.0 - 2.0 * kept * turn + kept * kept)
}

fn mean_power(bands: &[Band]) -> f64 {
    let lines: f64 = bands.iter().map(|b| b.lines).sum();
    bands.iter().map(|b| b.lines * b.power).sum::<f64>() / lines.max(f64::MIN_POSITIVE)
}

fn sum(variances: &[f64], shapes: &[Vec<f64>], band: usize) -> f64 {
    let each = variances.iter().zip(shapes);
    each.map(|(v, shape)| v * shape[band]).sum()
}

/// Less the log likelihood, where the power of a band is this.
fn unlikely(bands: &[Band], of: impl Fn(usize) -> f64) -> f64 {
    let one = |(i, band): (usize, &Band)| {
        let power = of(i).max(f64::MIN_POSITIVE);
        band.lines * (power.ln() + band.power / power)
    };
    bands.iter().enumerate().map(one).sum()
}

/// Variances, none below zero, that make the bands most probable.
fn fitted(bands: &[Band], shapes: &[Vec<f64>], white: f64) -> Vec<f64> {
    let mut variances = vec![white / shapes.len() as f64; shapes.len()];
    for _ in 0..ROUNDS {
        let here: Vec<f64> = (0..bands.len())
            .map(|b| sum(&variances, shapes, b))
            .collect();
        for (variance, shape) in variances.iter_mut().zip(shapes) {
            let (mut up, mut down) = (0.0, 0.0);
            for ((band, power), own) in bands.iter().zip(&here).zip(shape) {
                up += band.lines * own * band.power / (power * power);
                down += band.lines * own / power;
            }
            *variance *= (up / down.max(f64::MIN_POSITIVE)).sqrt();
        }
    }
    variances
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ground::random::Random;
    use crate::ground::stats::rms;

    const STEP: f64 = 1e-3;

    fn bands(power: impl Fn(f64) -> f64) -> Vec<Band> {
        let band = |i: i32| {
            let hz = 2.0 * 1.5_f64.powi(i);
            Band {
                hz,
                power: power(hz),
                lines: hz,
            }
        };
        (0..14).map(band).collect()
    }

    #[test]
    fn one_over_f_is_a_sum_of_relaxations() {
        let truth = |hz: f64| 1.0 + 30.0 / hz;
        let (noise, variance) = Relaxations::of(&bands(truth), STEP).unwrap();
        for hz in [3.0, 10.0, 40.0, 200.0] {
            let found = variance * noise.power(hz, STEP) / truth(hz);
            assert!((found - 1.0).abs() < 0.15, "{hz} {found}");
        }
        let slower = noise.clone().slower(5.0);
        let found = variance * slower.power(0.3, STEP) / truth(0.3);
        assert!((found - 1.0).abs() < 0.4, "{found}");
        assert!((noise.corner_hz(STEP) / 30.0 - 1.0).abs() < 0.4);
        assert!(Relaxations::of(&bands(|_| 4.0), STEP).is_none());
    }

    #[test]
    fn what_it_makes_comes_out_white() {
        let noise = Relaxations {
            white: 0.2,
            each: vec![[30.0, 0.5], [4.0, 0.3]],
            slowest: None,
        };
        let mut random = Random::new(5);
        let mut time = 0.0;
        let mut state = [
            0.5_f64.sqrt() * random.normal(),
            0.3_f64.sqrt() * random.normal(),
        ];
        let (mut times, mut readings) = (Vec::new(), Vec::new());
        for i in 0..6000 {
            let passed = if i % 500 == 0 { 0.3 } else { STEP };
            time += passed;
            for (s, [rate, v]) in state.iter_mut().zip(&noise.each) {
                let kept = (-rate * passed).exp();
                *s = kept * *s + (v * (1.0 - kept * kept)).sqrt() * random.normal();
            }
            times.push(time);
            readings.push(state[0] + state[1] + 0.2_f64.sqrt() * random.normal());
        }
        let white = noise.whitening(&times).apply(readings.into_iter());
        assert!((rms(&white) - 1.0).abs() < 0.03, "{}", rms(&white));
        for lag in [1, 5, 50] {
            let each = white.iter().zip(&white[lag..]);
            let together = each.map(|(a, b)| a * b).sum::<f64>() / white.len() as f64;
            assert!(together.abs() < 0.04, "{lag} {together}");
        }
    }
}
