//! A history without its noise: at every row the widest straight line or parabola that the noise allows.
//!
//! Windows on both sides, on the left and on the right of a row widen until their value leaves what all narrower ones
//! allow (Lepski 1991; Goldenshluger and Nemirovski 1997): wide on a ramp, one-sided at a corner, the reading itself
//! where nothing smooth passes.

use super::outliers::robust_std;
use crate::ground::stats::rms;
use nalgebra::{Matrix3, Vector3};

/// A history less its noise.
#[derive(Debug, Clone, PartialEq)]
pub struct Denoised {
    /// Its values.
    pub values: Vec<f64>,
    /// Deviation of a reading from them, unit of the values.
    pub noise: f64,
    /// What is left of that noise in the values, rms as a share of it.
    pub left: f64,
}

/// Standard errors by which a wider window may differ from a narrower one. At 1.1 to 1.5 the error is least for triangles, with
/// a jump or without, and sines of 60 to 120 rows in noise of 1 to 5 %; beyond, corners are rounded by more than noise is left.
const ALLOWED: f64 = 1.25;
/// Half widths of the windows, rows: each some 1.4 times the one before.
const WIDTHS: [usize; 13] = [2, 3, 4, 6, 8, 11, 16, 22, 32, 45, 64, 90, 128];

/// A window as it grows: rows before and after, and the degree of its curve.
struct Kind {
    before: bool,
    after: bool,
    degree: usize,
}

const KINDS: [Kind; 4] = [
    Kind {
        before: true,
        after: true,
        degree: 1,
    },
    Kind {
        before: true,
        after: true,
        degree: 2,
    },
    Kind {
        before: true,
        after: false,
        degree: 1,
    },
    Kind {
        before: false,
        after: true,
        degree: 1,
    },
];

impl Denoised {
    /// Of a history over time.
    pub fn of(time: &[f64], values: &[f64]) -> Self {
        let noise = roughness(time, values);
        let each = (0..values.len()).map(|i| at(time, values, (i, noise)));
        let (values, errors): (Vec<f64>, Vec<f64>) = each.unzip();
        Self {
            values,
            noise,
            left: rms(&errors),
        }
    }
}

/// Deviation of a reading from the line between its neighbours in time, robust against corners.
fn roughness(time: &[f64], values: &[f64]) -> f64 {
    let off = |i: usize| {
        let wide = time[i + 1] - time[i - 1];
        let share = if wide > 0.0 {
            (time[i] - time[i - 1]) / wide
        } else {
            0.5
        };
        let line = values[i - 1] + share * (values[i + 1] - values[i - 1]);
        (values[i] - line) / (1.0 + share * share + (1.0 - share).powi(2)).sqrt()
    };
    let off: Vec<f64> = (1..values.len().saturating_sub(1)).map(off).collect();
    robust_std(&off)
}

/// Value at a row and its standard error, noise deviations.
fn at(time: &[f64], values: &[f64], (row, noise): (usize, f64)) -> (f64, f64) {
    let each = KINDS
        .iter()
        .map(|kind| widest(time, values, (row, noise), kind));
    let best = each.min_by(|a, b| a.1.total_cmp(&b.1));
    best.unwrap_or((values[row], 1.0))
}

/// The widest window of a kind that agrees with all narrower ones.
fn widest(time: &[f64], values: &[f64], (row, noise): (usize, f64), kind: &Kind) -> (f64, f64) {
    let mut found = (values[row], 1.0);
    let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
    let allow = |(value, error): (f64, f64), (low, high): (f64, f64)| {
        let far = ALLOWED * error * noise;
        (low.max(value - far), high.min(value + far))
    };
    (low, high) = allow(found, (low, high));
    for width in WIDTHS {
        let from = if kind.before {
            row.checked_sub(width)
        } else {
            Some(row)
        };
        let to = if kind.after { row + width } else { row };
        let (Some(from), true) = (from, to < values.len()) else {
            break;
        };
        let Some(wider) = fitted(
            (&time[from..=to], &values[from..=to]),
            time[row],
            kind.degree,
        ) else {
            continue;
        };
        (low, high) = allow(wider, (low, high));
        if low > high {
            break;
        }
        found = wider;
    }
    found
}

/// Value at an instant of the curve through a window, and its standard error in noise deviations.
fn fitted((time, values): (&[f64], &[f64]), now: f64, degree: usize) -> Option<(f64, f64)> {
    let wide = time.last()? - time.first()?;
    if wide <= 0.0 || time.len() <= degree + 1 {
        return None;
    }
    let (mut own, mut cross) = (Matrix3::zeros(), Vector3::zeros());
    for (t, v) in time.iter().zip(values) {
        let x = (t - now) / wide;
        let row = Vector3::new(1.0, x, if degree > 1 { x * x } else { 0.0 });
        own += row * row.transpose();
        cross += row * (v - values[0]);
    }
    if degree < 2 {
        own[(2, 2)] = 1.0;
    }
    let inverse = own.try_inverse()?;
    let value = values[0] + (inverse * cross)[0];
    let error = inverse[(0, 0)].sqrt();
    (value.is_finite() && error.is_finite()).then_some((value, error))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ground::random::Random;
    use crate::ground::stats::difference;

    /// Triangles with a jump, a row every second.
    fn history(i: usize) -> f64 {
        let phase = (i as f64 / 120.0).fract();
        4.0 * (phase - 0.5).abs() - 1.0 + f64::from(u8::from(i > 400))
    }

    #[test]
    fn keeps_corners_and_jumps_and_takes_the_noise_away() {
        let mut random = Random::new(4);
        let time: Vec<f64> = (0..600).map(f64::from).collect();
        let truth: Vec<f64> = (0..600).map(history).collect();
        let read: Vec<f64> = truth.iter().map(|v| v + 0.05 * random.normal()).collect();
        let found = Denoised::of(&time, &read);
        let off = difference(&found.values, &truth);
        assert!((found.noise / 0.05 - 1.0).abs() < 0.2, "{}", found.noise);
        assert!(rms(&off) < 0.5 * 0.05, "{} of the noise", rms(&off) / 0.05);
        assert!(found.left < 0.4, "{}", found.left);
    }

    #[test]
    fn leaves_a_history_without_noise_as_it_is() {
        let time: Vec<f64> = (0..600).map(f64::from).collect();
        let truth: Vec<f64> = (0..600).map(history).collect();
        let found = Denoised::of(&time, &truth);
        let off = difference(&found.values, &truth);
        assert!(rms(&off) < 1e-3, "{}", rms(&off));
    }
}
