//! A correction of the path: a vector over the arc length, smooth enough for a robot.

use crate::ground::spatial::{V3, add, norm, scale, sub};

/// Corrections at even stations, the control points of a spline: m, workpiece frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Correction {
    step_m: f64,
    values: Vec<V3>,
}

/// Distance of its stations, m.
const STEP: f64 = 0.1e-3;
/// Standard deviation of the smoothing, m: an entry rises over millimetres, and a robot that plunges
/// at 10 mm/s swings once on the way of one.
const SMOOTH: f64 = 0.1e-3;

impl Correction {
    /// None, over a path of this length (m).
    pub fn none(length_m: f64) -> Self {
        let count = (length_m / STEP).ceil().max(0.0) as usize + 2;
        Self {
            step_m: STEP,
            values: vec![[0.0; 3]; count],
        }
    }

    /// The correction at arc length `s` (m): a uniform cubic B-spline over its stations, twice
    /// continuously differentiable.
    pub fn at(&self, s: f64) -> V3 {
        let last = self.values.len() - 1;
        let x = (s / self.step_m).clamp(0.0, last as f64);
        let i = (x as usize).min(last.saturating_sub(1));
        let u = x - i as f64;
        let w = 1.0 - u;
        let weights = [
            w * w * w,
            4.0 - 6.0 * u * u + 3.0 * u * u * u,
            4.0 - 6.0 * w * w + 3.0 * w * w * w,
            u * u * u,
        ];
        let places = [i.saturating_sub(1), i, i + 1, i + 2].map(|k| self.values[k.min(last)]);
        let each = places.iter().zip(weights);
        each.fold([0.0; 3], |sum, (p, w)| add(sum, scale(w / 6.0, *p)))
    }

    /// Takes what is left, given at ascending arc lengths, away: smoothed.
    pub fn take(&mut self, left: &[(f64, V3)]) {
        let each = self.values.iter().zip(self.smoothed(left));
        *self = self.with(each.map(|(value, left)| sub(*value, left)).collect());
    }

    /// Its control points, m.
    pub(super) fn values(&self) -> &[V3] {
        &self.values
    }

    /// The same stations with other control points, m.
    pub(super) fn with(&self, values: Vec<V3>) -> Self {
        Self { values, ..*self }
    }

    /// Samples at ascending arc lengths at its stations: linear between them, nothing outside.
    pub(super) fn resampled(&self, samples: &[(f64, V3)]) -> Vec<V3> {
        resampled(samples, self.step_m, self.values.len())
    }

    /// The same, smooth enough to be a correction.
    pub(super) fn smoothed(&self, samples: &[(f64, V3)]) -> Vec<V3> {
        smoothed(&self.resampled(samples), SMOOTH / self.step_m)
    }

    /// Largest correction, m, and its arc length, m.
    pub fn largest(&self) -> (f64, f64) {
        let sizes = self
            .values
            .iter()
            .enumerate()
            .map(|(i, v)| (norm(*v), i as f64 * self.step_m));
        sizes.fold((0.0, 0.0), |a, b| if b.0 > a.0 { b } else { a })
    }

    /// Largest difference to another correction of the same path, m.
    pub fn farthest(&self, other: &Self) -> f64 {
        let pairs = self.values.iter().zip(&other.values);
        pairs.map(|(a, b)| norm(sub(*a, *b))).fold(0.0, f64::max)
    }
}

/// Linear between samples at ascending places, on an even grid; nothing outside.
fn resampled(samples: &[(f64, V3)], step: f64, count: usize) -> Vec<V3> {
    let mut after = 0;
    let at = |i: usize| {
        let s = i as f64 * step;
        while after < samples.len() && samples[after].0 < s {
            after += 1;
        }
        let (Some(b), Some(a)) = (
            samples.get(after),
            after.checked_sub(1).and_then(|i| samples.get(i)),
        ) else {
            return [0.0; 3];
        };
        let share = (s - a.0) / (b.0 - a.0).max(f64::MIN_POSITIVE);
        add(a.1, scale(share, sub(b.1, a.1)))
    };
    (0..count).map(at).collect()
}

/// Smoothed by a bell of this standard deviation in stations.
fn smoothed(values: &[V3], width: f64) -> Vec<V3> {
    let reach = (4.0 * width).ceil() as i64;
    let bell: Vec<f64> = (-reach..=reach)
        .map(|k| (-0.5 * (k as f64 / width).powi(2)).exp())
        .collect();
    let total: f64 = bell.iter().sum();
    let mean = |i: usize| {
        let weighed = bell.iter().enumerate().map(|(k, w)| {
            let j = (i as i64 + k as i64 - reach).clamp(0, values.len() as i64 - 1) as usize;
            scale(w / total, values[j])
        });
        weighed.fold([0.0; 3], add)
    };
    (0..values.len()).map(mean).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_is_taken_away() {
        let mut correction = Correction::none(0.1);
        let left: Vec<(f64, V3)> = (0..=400)
            .map(|i| {
                let s = 0.25e-3 * f64::from(i);
                (s, [0.0, 1e-4 * (60.0 * s).sin(), 0.0])
            })
            .collect();
        correction.take(&left);
        for s in [0.01, 0.0333, 0.07] {
            let [x, y, _] = correction.at(s);
            assert!(x == 0.0 && (y + 1e-4 * (60.0 * s).sin()).abs() < 2e-7);
        }
        assert!((correction.largest().0 - 1e-4).abs() < 2e-6);
    }
}
