//! The force pulse of one hit: where it is, how high, how long, above which baseline.

use super::outliers::median;
use std::ops::Range;

/// Samples before the pulse from which a baseline is taken; with fewer, the median of the record.
const ENOUGH_PRETRIGGER: usize = 16;

/// Standard deviations that the mean over the length of a pulse must keep to be noise.
const CLEAR: f64 = 5.5;

/// The main pulse of a force record.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pulse {
    /// Mean force before the pulse, N.
    pub baseline: f64,
    /// Standard deviation of the noise of the force channel (robust), N.
    pub noise: f64,
    /// Peak above the baseline, N, with the sign of the hit.
    pub peak: f64,
    /// Sample of the peak.
    pub at: usize,
    /// First sample of the pulse.
    pub start: usize,
    /// First sample after the pulse.
    pub end: usize,
}

impl Pulse {
    /// Finds the highest pulse of `force`; none if nothing stands clear of the noise.
    pub fn find(force: &[f64]) -> Option<Self> {
        let middle = median(force);
        let at = farthest(force, middle)?;
        let noise = spread(force, middle);
        let mut pulse = Self {
            baseline: middle,
            noise,
            peak: force[at] - middle,
            at,
            start: at,
            end: at + 1,
        };
        pulse.bound(force);
        pulse.baseline = baseline(force, pulse.start, middle);
        pulse.peak = force[at] - pulse.baseline;
        pulse.bound(force);
        (pulse.peak.abs() > 20.0 * noise && pulse.peak != 0.0).then_some(pulse)
    }

    /// Duration in samples.
    pub fn width(&self) -> usize {
        self.end - self.start
    }

    /// Sample (not whole) of the centroid of the pulse: the instant of the impulse.
    pub fn centroid(&self, force: &[f64]) -> f64 {
        let weights = (self.start..self.end).map(|i| (i as f64, force[i] - self.baseline));
        let (moment, area) = weights.fold((0.0, 0.0), |(m, a), (i, w)| (m + i * w, a + w));
        moment / area
    }

    /// Force at sample `i` above the baseline, positive in the direction of the hit, N.
    pub fn above(&self, force: &[f64], i: usize) -> f64 {
        (force[i] - self.baseline) * self.peak.signum()
    }

    /// Whether the record shows nothing but noise outside the samples `kept`: no mean over the length of
    /// the pulse stands clear of it. Hum, ringing and a slowly returning baseline do.
    pub fn quiet_outside(&self, force: &[f64], kept: Range<usize>) -> bool {
        let width = self.width().max(1);
        let before = &force[..kept.start.min(force.len())];
        let after = force.get(kept.end..).unwrap_or(&[]);
        let level = CLEAR * white(after) * (width as f64).sqrt();
        let mut sums = [before, after].into_iter().flat_map(|rest| {
            let parts = rest.windows(width);
            parts.map(|part| part.iter().map(|v| v - self.baseline).sum::<f64>().abs())
        });
        after.len() > 4 * width && sums.all(|sum| sum <= level)
    }

    fn bound(&mut self, force: &[f64]) {
        let floor = (0.02 * self.peak.abs()).max(3.0 * self.noise);
        let inside = |i: &usize| self.above(force, *i) > floor;
        let start = (0..self.at).rev().take_while(inside).last();
        let end = (self.at..force.len()).take_while(inside).last();
        self.start = start.unwrap_or(self.at);
        self.end = end.unwrap_or(self.at) + 1;
    }
}

/// How many samples before `start` give a baseline. The last quarter of them is left out: filters ring
/// before the pulse.
pub fn quiet(start: usize) -> usize {
    start - start / 4
}

/// Mean over the samples before `start` that are [`quiet`], `otherwise` if they are too few.
pub fn baseline(record: &[f64], start: usize, otherwise: f64) -> f64 {
    let quiet = quiet(start);
    if quiet < ENOUGH_PRETRIGGER {
        return otherwise;
    }
    record[..quiet].iter().sum::<f64>() / quiet as f64
}

/// Standard deviation of the samples before `start` that are [`quiet`]; none if they are too few.
pub fn noise_before(record: &[f64], start: usize) -> Option<f64> {
    let before = record.get(..quiet(start))?;
    (before.len() >= ENOUGH_PRETRIGGER).then(|| spread(before, median(before)))
}

/// Standard deviation as 1.4826 times the median absolute deviation from `middle`.
pub fn spread(values: &[f64], middle: f64) -> f64 {
    let away: Vec<f64> = values.iter().map(|v| (v - middle).abs()).collect();
    1.4826 * median(&away)
}

/// Standard deviation of white noise in `values` by the differences of neighbours, which see little of hum
/// and slow parts.
fn white(values: &[f64]) -> f64 {
    let steps: Vec<f64> = values.windows(2).map(|two| two[1] - two[0]).collect();
    spread(&steps, 0.0) / std::f64::consts::SQRT_2
}

fn farthest(values: &[f64], middle: f64) -> Option<usize> {
    let away = |i: &usize| (values[*i] - middle).abs();
    (0..values.len()).max_by(|a, b| away(a).total_cmp(&away(b)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ground::random::Random;

    /// A pulse of 200 N over ten samples, noise of 1 N, another pulse of `second` N.
    fn record(second: f64) -> (Vec<f64>, Pulse) {
        let mut random = Random::new(3);
        let bump = |i: usize, at: usize| match (at..at + 10).contains(&i) {
            true => (std::f64::consts::PI * (i - at) as f64 / 10.0).sin(),
            false => 0.0,
        };
        let force: Vec<f64> = (0..1000)
            .map(|i| 200.0 * bump(i, 50) + second * bump(i, 90) + random.normal())
            .collect();
        let pulse = Pulse::find(&force).unwrap();
        (force, pulse)
    }

    #[test]
    fn a_force_is_quiet_outside_a_single_pulse() {
        let (force, pulse) = record(0.0);
        assert!(pulse.quiet_outside(&force, 40..70));
        let (force, pulse) = record(8.0);
        assert!(!pulse.quiet_outside(&force, 40..70));
    }

    #[test]
    fn hum_is_not_quiet() {
        let (mut force, _) = record(0.0);
        for (i, value) in force.iter_mut().enumerate() {
            *value += 3.0 * (0.1 * std::f64::consts::PI * i as f64).sin();
        }
        let pulse = Pulse::find(&force).unwrap();
        assert!(!pulse.quiet_outside(&force, 40..70));
    }

    #[test]
    fn a_record_that_ends_with_the_pulse_says_nothing() {
        let (force, pulse) = record(0.0);
        assert!(!pulse.quiet_outside(&force[..75], 40..70));
        assert!(!pulse.quiet_outside(&force[..75], 40..90));
    }
}
