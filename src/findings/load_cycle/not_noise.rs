//! What no noise does: jump from level to level, go one way or swing in bursts, swell in the middle of the band.

use super::families::View;
use super::noise::{Coloured, above_neighbours, differences, is_one_sided, is_swinging, windows};
use super::repeats::repeats;
use crate::ground::stats::{MEDIAN_OF_SQUARES, median};
use crate::signal::outliers;
use crate::signal::steps::{sharpest, steps, window};

/// A coloured noise so many times the scatter of neighbouring readings is a word for what nobody has explained:
/// clean 1/f noise reaches about 2 (load cycles of `tests/judge`, seeds 1 to 3).
const SWOLLEN: f64 = 3.5;
/// So many times that scatter may be a walk: what every reading keeps of the one before is then 97 % at the most.
const WALKS: f64 = 7.0;
/// Distances of readings over which a walk is looked at, and normal deviations within which what is left of it is usual.
const LAGS: usize = 24;
const USUAL: f64 = 2.3;
/// Isolated changes of level that are no noise: coloured noise swallows a structure with many kinks, its
/// differences do not.
const JUMPS: usize = 5;
/// The same of changes between the means of several rows, away from turning points, where laws of loops are wrong.
const LEVELS: usize = 4;
/// Robust deviations from which a change is none of noise, whatever its colour: noise of any colour changes by normal
/// amounts over any number of rows.
const FAR: f64 = 6.0;
/// What jumps show.
const LEAPS: &str = "jumps from level to level";
/// Nats by which a spectrum that rises must be better than one that falls, and the least amplitude of what
/// rises, deviations of one reading.
const RISING: (f64, f64) = (16.0, 2.0);
/// First coefficient that is looked at.
const FIRST: usize = 6;

/// What a residual holds that no noise makes, whatever its colour, in words; none of noise.
pub fn no_noise(residual: &[f64], noise: &Coloured, view: &View) -> Option<&'static str> {
    let windows = windows(residual);
    let each = residual.iter().zip(&noise.spread);
    let own: Vec<f64> = each.map(|(r, s)| r / s).collect();
    let seen = [
        (jumps(residual, view) >= JUMPS || levels(&own, view) >= LEVELS).then_some(LEAPS),
        is_one_sided(residual, &windows).then_some("errors that come in bursts and go one way"),
        is_swinging(residual, &windows).then_some("swings that come and go"),
        is_rising(residual, noise, view)
            .then_some("an oscillation that is larger than what is slower than it"),
        is_swollen(residual, &own, noise).then_some(
            "a slow wander many times as large as what neighbouring readings scatter by",
        ),
        (!view.stepped && repeats(&own, &view.u, &view.half_cycle))
            .then_some("a fine pattern that comes back at the same loads"),
    ];
    seen.into_iter().flatten().next()
}

/// Whether it is far above the scatter of its neighbours and no plain walk that always comes back, which no structure is.
fn is_swollen(residual: &[f64], own: &[f64], noise: &Coloured) -> bool {
    let above = above_neighbours(residual, &noise.spread);
    above > SWOLLEN && (above > WALKS || !is_walk(own))
}

/// Whether what every reading keeps of the one before leaves white noise (an autoregression of the first order): by the sum of squared
/// correlations over many distances (Ljung and Box 1978), its distribution by Wilson and Hilferty 1931.
fn is_walk(own: &[f64]) -> bool {
    let correlation = |v: &[f64], far: usize| -> f64 {
        let both = v.iter().zip(&v[far.min(v.len())..]);
        let square: f64 = v.iter().map(|x| x * x).sum();
        both.map(|(a, b)| a * b).sum::<f64>() / square.max(f64::MIN_POSITIVE)
    };
    let kept = correlation(own, 1);
    let new: Vec<f64> = own.windows(2).map(|w| w[1] - kept * w[0]).collect();
    let (rows, lags) = (new.len() as f64, (new.len() / 6).min(LAGS));
    if lags < 4 {
        return false;
    }
    let sum: f64 = (1..=lags)
        .map(|far| correlation(&new, far).powi(2) / (rows - far as f64))
        .sum();
    let (square, count) = (rows * (rows + 2.0) * sum, lags as f64 - 1.0);
    let step = 2.0 / (9.0 * count);
    ((square / count).cbrt() - (1.0 - step)) / step.sqrt() < USUAL
}

/// Isolated changes of level in a residual that are far above the noise of its differences. A wild reading
/// goes and comes back at once; where the load jumps, timing alone makes one.
fn jumps(residual: &[f64], view: &View) -> usize {
    let own = differences(residual);
    let spread = outliers::robust_std(&own);
    let far = |i: usize| own[i].abs() > FAR * spread && spread > 0.0;
    let calm = |i: usize| own[i].abs() < 0.5 * FAR * spread;
    let moved = |i: usize| (view.u[i + 1] - view.u[i]).abs() > 0.04;
    (1..own.len().saturating_sub(1))
        .filter(|i| far(*i) && calm(i - 1) && calm(i + 1) && !moved(*i))
        .count()
}

/// Isolated changes of level between the means of several rows.
fn levels(own: &[f64], view: &View) -> usize {
    let (mut steps, wide) = (steps(own), window(own.len()));
    let spread = outliers::robust_std(&steps);
    let straight = |i: usize| {
        let (from, to) = (i.saturating_sub(wide), (i + wide).min(own.len() - 1));
        view.half_cycle[from] == view.half_cycle[to]
    };
    for (i, step) in steps.iter_mut().enumerate() {
        if step.abs() <= FAR * spread || !straight(i) {
            *step = 0.0;
        }
    }
    sharpest(&steps, LEVELS).len()
}

/// Whether the spectrum rises with the frequency: noise is even or falls, an oscillation rises above what
/// lies below it.
fn is_rising(residual: &[f64], noise: &Coloured, view: &View) -> bool {
    let power: Vec<f64> = noise.spectrum(residual);
    let end = (view.slow * power.len() as f64) as usize;
    if end < 4 * FIRST {
        return false;
    }
    let bands = bands(&power[..end]);
    let falling = falling(&bands);
    let each = bands.iter().zip(&falling);
    let nats: f64 = each
        .clone()
        .map(|((p, count), f)| 0.5 * count * (f / p).ln())
        .sum();
    // power above the least that lies below it
    let mut least = f64::INFINITY;
    let mut above = 0.0;
    for (p, count) in &bands {
        above += (p - least).max(0.0) * count;
        least = least.min(*p);
    }
    let level = median(&power) / MEDIAN_OF_SQUARES;
    let amplitude = (2.0 * above / (level * power.len() as f64).max(f64::MIN_POSITIVE)).sqrt();
    nats > RISING.0 && amplitude > RISING.1
}

/// Mean power and count of bands whose width grows with the frequency.
fn bands(power: &[f64]) -> Vec<(f64, f64)> {
    let mut bands = Vec::new();
    let mut from = FIRST;
    while from < power.len() {
        let to = (from + (from / 6).max(4)).min(power.len());
        let sum: f64 = power[from..to].iter().sum();
        let count = (to - from) as f64;
        bands.push((sum.max(f64::MIN_POSITIVE) / count, count));
        from = to;
    }
    bands
}

/// The falling spectrum that is nearest: neighbours that rise are pooled (Ayer and others 1955).
fn falling(bands: &[(f64, f64)]) -> Vec<f64> {
    let mut pools: Vec<(f64, f64, usize)> = Vec::new();
    for (p, count) in bands {
        let mut own = (*p, *count, 1);
        while let Some(last) = pools.last().copied().filter(|last| last.0 < own.0) {
            let count = last.1 + own.1;
            own = (
                (last.0 * last.1 + own.0 * own.1) / count,
                count,
                last.2 + own.2,
            );
            pools.pop();
        }
        pools.push(own);
    }
    let each = pools.iter().flat_map(|p| std::iter::repeat_n(p.0, p.2));
    each.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ground::random::Random;

    /// Noise that keeps nine tenths and more of itself is noise; a smooth curve under white noise, as large beside its neighbours, is none.
    #[test]
    fn a_walk_that_comes_back_is_noise_and_a_curve_is_none() {
        let count = |of: &dyn Fn(&mut Random) -> Vec<f64>| {
            let each = (0..100).map(|seed| of(&mut Random::new(seed)));
            each.filter(|left| is_walk(left)).count()
        };
        let walk = |random: &mut Random| {
            let mut at = 0.0;
            let mut next = || {
                at = 0.94 * at + random.normal();
                at
            };
            (0..300).map(|_| next()).collect()
        };
        let curve = |random: &mut Random| {
            let at = |i: usize| 4.0 * (i as f64 / 30.0).sin() + random.normal();
            (0..300).map(at).collect()
        };
        assert!(count(&walk) > 93);
        assert!(count(&curve) < 3);
    }
}
