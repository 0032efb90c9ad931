//! A hum: one tone that goes through a whole record, as the mains put it on a cable.
//!
//! Even rows fold it into their own band, where it is a line of the spectrum and part of the noise. Uneven rows do not fold it, and no line
//! shows: there it is sought at the mains' own frequencies, in what is left of a record beside its neighbours (least squares over the frequency:
//! Lomb 1976).

use super::mains::{HARMONICS, MAINS_HZ};
use crate::ground::stats::{difference, mean, rms};
use std::f64::consts::TAU;

/// A tone.
#[derive(Debug, Clone, PartialEq)]
pub struct Hum {
    /// Its frequency, Hz.
    pub frequency: f64,
    /// What it is in every row.
    pub course: Vec<f64>,
}

/// Rows on either side whose mean is taken off before a tone is sought.
const BESIDE: usize = 4;
/// Rows below which none is sought.
const FEWEST: usize = 100;
/// Nats that a tone must gain above the logarithm of how many were tried. One clean record in 10⁴ has such a tone by chance; a choice.
const SURE: f64 = 9.0;
/// Spread of the distances between rows, of their mean, above which rows are uneven and fold nothing.
const UNEVEN: f64 = 0.05;
/// How far the mains are off, Hz, and the most frequencies that are tried there on either side, a choice for time.
const OFF: f64 = 0.3;
const MOST: f64 = 500.0;
/// Frequencies that are tried in the width of a line, and halvings of their distance.
const FINE: f64 = 4.0;
const HALVINGS: usize = 12;

impl Hum {
    /// The tone of a record at these times, s, if they are uneven and it has one.
    pub fn of(time: &[f64], values: &[f64]) -> Option<Self> {
        if values.len() < FEWEST || values.len() != time.len() || is_even(time) {
            return None;
        }
        let own = beside(values);
        let (first, step, tried) = of_mains(time, &own)?;
        let gain = |hz: f64| gain(time, &own, hz);
        let frequency = climbed(first, step, &gain);
        let course = tone(time, &own, frequency).1;
        (gain(frequency) > (tried as f64).ln() + SURE).then_some(Self { frequency, course })
    }
}

/// Values less the mean of their neighbours: what is slow goes.
fn beside(values: &[f64]) -> Vec<f64> {
    let near =
        |i: usize| mean(&values[i.saturating_sub(BESIDE)..(i + BESIDE + 1).min(values.len())]);
    (0..values.len()).map(|i| values[i] - near(i)).collect()
}

fn is_even(time: &[f64]) -> bool {
    let apart: Vec<f64> = time.windows(2).map(|w| w[1] - w[0]).collect();
    let usual = mean(&apart);
    let off: Vec<f64> = apart.iter().map(|h| h - usual).collect();
    rms(&off) < UNEVEN * usual
}

/// Strongest frequency near the mains, the distance to the next and how many were tried.
fn of_mains(time: &[f64], own: &[f64]) -> Option<(f64, f64, usize)> {
    let wide = time.last()? - time.first()?;
    let step = 1.0 / (FINE * wide);
    let each = OFF / step;
    if !(each > 0.0 && each < MOST) {
        return None;
    }
    let each = each as i64;
    let all = HARMONICS.iter().flat_map(|n| MAINS_HZ.map(|own| n * own));
    let all: Vec<f64> = all
        .flat_map(|hz| (-each..=each).map(move |k| hz + k as f64 * step))
        .collect();
    let best = all
        .iter()
        .map(|hz| (gain(time, own, *hz), *hz))
        .max_by(|a, b| a.0.total_cmp(&b.0))?;
    Some((best.1, step, all.len()))
}

/// From a frequency up to where the gain is greatest.
fn climbed(first: f64, step: f64, gain: &dyn Fn(f64) -> f64) -> f64 {
    let (mut best, mut step) = ((gain(first), first), step);
    for _ in 0..HALVINGS {
        step *= 0.5;
        for hz in [best.1 - step, best.1 + step] {
            let own = gain(hz);
            if own > best.0 {
                best = (own, hz);
            }
        }
    }
    best.1
}

/// Nats that a tone of this frequency gains in values less the mean of their neighbours.
fn gain(time: &[f64], own: &[f64], hz: f64) -> f64 {
    let seen = tone(time, own, hz).0;
    let left = rms(&difference(own, &seen)).max(f64::MIN_POSITIVE);
    own.len() as f64 * (rms(own) / left).ln()
}

/// The tone of a frequency that leaves least: as it is seen beside its neighbours, and as it is.
fn tone(time: &[f64], own: &[f64], hz: f64) -> (Vec<f64>, Vec<f64>) {
    let wave = |phase: f64| -> Vec<f64> {
        time.iter()
            .map(|t| (TAU * hz * (t - time[0]) + phase).sin())
            .collect()
    };
    let whole = [wave(0.0), wave(0.25 * TAU)];
    let seen = [beside(&whole[0]), beside(&whole[1])];
    let dot = |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
    let [ss, cc, sc] = [
        dot(&seen[0], &seen[0]),
        dot(&seen[1], &seen[1]),
        dot(&seen[0], &seen[1]),
    ];
    let [s, c] = [dot(&seen[0], own), dot(&seen[1], own)];
    let det = ss * cc - sc * sc;
    let (a, b) = match det > 1e-9 * ss * cc {
        true => ((s * cc - c * sc) / det, (c * ss - s * sc) / det),
        false => (s / ss.max(f64::MIN_POSITIVE), 0.0),
    };
    let mix = |of: &[Vec<f64>; 2]| {
        of[0]
            .iter()
            .zip(&of[1])
            .map(|(x, y)| a * x + b * y)
            .collect()
    };
    (mix(&seen), mix(&whole))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ground::random::Random;

    /// A slow course with noise of one, at times that are even or not, and a tone of this size and frequency.
    fn record(uneven: f64, (size, hz): (f64, f64)) -> (Vec<f64>, Vec<f64>, Vec<f64>) {
        let mut random = Random::new(3);
        let time: Vec<f64> = (0..800)
            .map(|i| 0.069 * (f64::from(i) + uneven * random.normal()))
            .collect();
        let tone: Vec<f64> = time
            .iter()
            .map(|t| size * (TAU * hz * t + 1.0).sin())
            .collect();
        let slow = time.iter().map(|t| 20.0 * (0.3 * t).sin());
        let values = slow
            .zip(&tone)
            .map(|(s, t)| s + t + random.normal())
            .collect();
        (time, values, tone)
    }

    #[test]
    fn a_hum_is_found_in_uneven_rows() {
        let (time, values, tone) = record(0.2, (1.5, 50.03));
        let found = Hum::of(&time, &values).unwrap();
        let left = rms(&difference(&found.course, &tone));
        assert!(left < 0.15, "{left} of 1.06 is left");
    }

    #[test]
    fn even_rows_noise_and_slow_swings_have_none() {
        let none = [(0.0, (1.5, 50.03)), (0.2, (0.0, 50.0)), (0.2, (3.0, 0.4))];
        for (uneven, tone) in none {
            let (time, values, _) = record(uneven, tone);
            assert_eq!(Hum::of(&time, &values), None);
        }
        assert_eq!(Hum::of(&[0.0], &[1.0]), None);
        assert_eq!(Hum::of(&[0.0; 200], &[1.0; 200]), None);
    }
}
