//! The force pulse of one hit: where it is, how high, how long, above which baseline.

/// Samples before the pulse from which a baseline is taken; with fewer, the median of the record.
const ENOUGH_PRETRIGGER: usize = 16;

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

    fn bound(&mut self, force: &[f64]) {
        let floor = (0.02 * self.peak.abs()).max(3.0 * self.noise);
        let inside = |i: &usize| self.above(force, *i) > floor;
        let start = (0..self.at).rev().take_while(inside).last();
        let end = (self.at..force.len()).take_while(inside).last();
        self.start = start.unwrap_or(self.at);
        self.end = end.unwrap_or(self.at) + 1;
    }
}

/// Mean over the samples before `start`, `otherwise` if they are too few. The last quarter of them
/// is left out: filters ring before the pulse.
pub fn baseline(record: &[f64], start: usize, otherwise: f64) -> f64 {
    let quiet = start - start / 4;
    if quiet < ENOUGH_PRETRIGGER {
        return otherwise;
    }
    record[..quiet].iter().sum::<f64>() / quiet as f64
}

/// Median; 0 for nothing.
pub fn median(values: &[f64]) -> f64 {
    if values.is_empty() {
        return 0.0;
    }
    let mut copy = values.to_vec();
    let half = copy.len() / 2;
    *copy.select_nth_unstable_by(half, f64::total_cmp).1
}

/// Standard deviation as 1.4826 times the median absolute deviation from `middle`.
pub fn spread(values: &[f64], middle: f64) -> f64 {
    let away: Vec<f64> = values.iter().map(|v| (v - middle).abs()).collect();
    1.4826 * median(&away)
}

fn farthest(values: &[f64], middle: f64) -> Option<usize> {
    let away = |i: &usize| (values[*i] - middle).abs();
    (0..values.len()).max_by(|a, b| away(a).total_cmp(&away(b)))
}
