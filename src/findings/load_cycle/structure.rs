//! The discrepancy before any cause: how large, where.

use crate::findings::answer::{Discrepancy, Structure};
use crate::findings::engine::Remaining;
use crate::fit::observation::Observation;
use crate::fit::screen::directions;
use crate::ground::stats::ends;

/// Bins of the pictures.
const BINS: usize = 12;

/// Measures reading − simulation.
pub fn discrepancy(residual: &[f64], data: &Observation, noise_rms: f64) -> Discrepancy {
    let squares: f64 = residual.iter().map(|r| r * r).sum();
    Discrepancy {
        rms: (squares / residual.len().max(1) as f64).sqrt(),
        noise_rms,
        place: place(residual, data),
    }
}

/// Part of the rows below which no place is judged.
const FEW: usize = 20;

/// Where the mean square is most concentrated: over load, branch or time. Over branch and time it is
/// compared with what the loads there let expect: growing cycles alone make nothing late.
pub fn place(residual: &[f64], data: &Observation) -> String {
    let n = residual.len();
    let load = |i: usize| data.scene.load[i].abs() / data.scene.load_scale;
    let scaled: Vec<f64> = data
        .scene
        .load
        .iter()
        .map(|m| m / data.scene.load_scale)
        .collect();
    let direction = directions(&scaled);
    let square: Vec<f64> = residual.iter().map(|r| r * r).collect();
    let even = vec![square.iter().sum::<f64>() / n.max(1) as f64; n];
    let of_load = mean_by_load(&square, load);
    let share = |expected: &[f64], keep: &dyn Fn(usize) -> bool| {
        let inside: Vec<usize> = (0..n).filter(|i| keep(*i)).collect();
        let sum = |of: &[f64]| inside.iter().map(|i| of[*i]).sum::<f64>();
        match inside.len() * FEW < n || sum(expected) <= 0.0 {
            true => 0.0,
            false => sum(&square) / sum(expected),
        }
    };
    let rising = |i: usize| direction[i] > 0.0;
    let places: [(&str, f64); 6] = [
        ("largest near zero load", share(&even, &|i| load(i) < 0.25)),
        ("largest at high load", share(&even, &|i| load(i) > 0.75)),
        ("largest while the load rises", share(&of_load, &rising)),
        (
            "largest while the load falls",
            share(&of_load, &|i| direction[i] < 0.0),
        ),
        (
            "largest early in the record",
            share(&of_load, &|i| i < n / 3),
        ),
        (
            "largest late in the record",
            share(&of_load, &|i| i > 2 * n / 3),
        ),
    ];
    let best = places.iter().max_by(|a, b| a.1.total_cmp(&b.1));
    best.filter(|b| b.1 > 1.3)
        .map_or("spread evenly over the record".into(), |b| b.0.into())
}

/// The mean of `values` among the rows of like magnitude of load (0 to 1), row by row.
fn mean_by_load(values: &[f64], load: impl Fn(usize) -> f64) -> Vec<f64> {
    let bin = |i: usize| ((load(i) * BINS as f64) as usize).min(BINS - 1);
    let mut sums = [(0.0, 0.0); BINS];
    for (i, value) in values.iter().enumerate() {
        sums[bin(i)].0 += value;
        sums[bin(i)].1 += 1.0;
    }
    (0..values.len())
        .map(|i| sums[bin(i)].0 / sums[bin(i)].1)
        .collect()
}

/// Pictures a residual. `before` is the mean square of the discrepancy, `noise` the noise rms.
pub fn structure(
    residual: &[f64],
    data: &Observation,
    before: f64,
    noise: f64,
    test: &str,
) -> Structure {
    let square = residual.iter().map(|r| r * r).sum::<f64>() / residual.len().max(1) as f64;
    let share = ((square - noise * noise) / before.max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    let shape = binned(&data.scene.load, residual);
    let over_time = binned(&data.scene.time, residual);
    let swing = |v: &[[f64; 2]]| {
        let (low, high) = ends(&v.iter().map(|p| p[1]).collect::<Vec<_>>());
        high - low
    };
    let description = match (test, swing(&shape) > swing(&over_time)) {
        ("periodic line", _) => "a periodic oscillation in time that follows no load.".to_string(),
        (_, true) => "a pattern over the load that repeats in every cycle.".to_string(),
        (_, false) => "a pattern over time that does not follow the load.".to_string(),
    };
    Structure {
        share_of_variance: share,
        shape,
        over_time,
        description,
    }
}

/// What is left, over load and over time.
pub fn remaining(residual: &[f64], data: &Observation) -> Remaining {
    let left = structure(residual, data, 1.0, 0.0, "");
    Remaining {
        shape: left.shape,
        over_time: left.over_time,
        description: left.description,
    }
}

/// Means of `y` in bins of `x`.
pub fn binned(x: &[f64], y: &[f64]) -> Vec<[f64; 2]> {
    let (low, high) = ends(x);
    if high <= low {
        return Vec::new();
    }
    let mut sums = [[0.0; 3]; BINS];
    for (a, b) in x.iter().zip(y) {
        let bin = (((a - low) / (high - low) * BINS as f64) as usize).min(BINS - 1);
        sums[bin][0] += a;
        sums[bin][1] += b;
        sums[bin][2] += 1.0;
    }
    sums.iter()
        .filter(|s| s[2] > 0.0)
        .map(|s| [s[0] / s[2], s[1] / s[2]])
        .collect()
}
