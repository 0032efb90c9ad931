//! The discrepancy before any cause: how large, where.

use crate::fit::observation::Observation;
use crate::fit::screen::directions;

/// How far the present simulation is off.
#[derive(Debug, Clone, PartialEq)]
pub struct Discrepancy {
    /// Rms of reading − simulation, rad or m.
    pub rms: f64,
    /// Noise that the data themselves show.
    pub noise_rms: f64,
    /// Where it is largest, a phrase.
    pub place: String,
}

/// Structure that is left, without a model: means over load on either branch, and over time.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Structure {
    /// Share of the discrepancy's variance that nothing explained.
    pub share_of_variance: f64,
    /// Mean residual over load: [load, residual].
    pub shape: Vec<[f64; 2]>,
    /// Mean residual over time: [s, residual].
    pub over_time: Vec<[f64; 2]>,
    /// What is seen, in words.
    pub description: String,
}

/// Bins of the pictures.
const BINS: usize = 12;

impl Discrepancy {
    /// Measures reading − simulation.
    pub fn of(residual: &[f64], data: &Observation, noise_rms: f64) -> Self {
        let rms =
            (residual.iter().map(|r| r * r).sum::<f64>() / residual.len().max(1) as f64).sqrt();
        Self {
            rms,
            noise_rms,
            place: place(residual, data),
        }
    }
}

/// Where the mean square is most concentrated: over load, branch or time.
fn place(residual: &[f64], data: &Observation) -> String {
    let load = |i: usize| data.scene.load[i].abs() / data.scene.load_scale;
    let n = residual.len();
    let share = |keep: &dyn Fn(usize) -> bool| {
        let (mut inside, mut all, mut rows) = (0.0, 0.0, 0usize);
        for (i, r) in residual.iter().enumerate() {
            all += r * r;
            if keep(i) {
                inside += r * r;
                rows += 1;
            }
        }
        if rows * 20 < n || all <= 0.0 {
            0.0
        } else {
            inside / all * n as f64 / rows as f64
        }
    };
    let direction = directions(
        &data
            .scene
            .load
            .iter()
            .map(|m| m / data.scene.load_scale)
            .collect::<Vec<_>>(),
    );
    let places: [(&str, f64); 6] = [
        ("largest near zero load", share(&|i| load(i) < 0.25)),
        ("largest at high load", share(&|i| load(i) > 0.75)),
        (
            "largest while the load rises",
            share(&|i| direction[i] > 0.0),
        ),
        (
            "largest while the load falls",
            share(&|i| direction[i] < 0.0),
        ),
        ("largest early in the record", share(&|i| i < n / 3)),
        ("largest late in the record", share(&|i| i > 2 * n / 3)),
    ];
    let best = places.iter().max_by(|a, b| a.1.total_cmp(&b.1));
    best.filter(|b| b.1 > 1.3)
        .map_or("spread evenly over the record".into(), |b| b.0.into())
}

impl Structure {
    /// Pictures a residual. `before` is the mean square of the discrepancy, `noise` the noise rms.
    pub fn of(residual: &[f64], data: &Observation, before: f64, noise: f64, test: &str) -> Self {
        let square = residual.iter().map(|r| r * r).sum::<f64>() / residual.len().max(1) as f64;
        let share = ((square - noise * noise) / before.max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        let shape = binned(&data.scene.load, residual);
        let over_time = binned(&data.scene.time, residual);
        let swing = |v: &[[f64; 2]]| {
            v.iter()
                .fold((f64::MAX, f64::MIN), |(l, h), p| (l.min(p[1]), h.max(p[1])))
                .1
                - v.iter().fold(f64::MAX, |l, p| l.min(p[1]))
        };
        let description = match (test, swing(&shape) > swing(&over_time)) {
            ("periodic line", _) => {
                "a periodic oscillation in time that follows no load.".to_string()
            }
            (_, true) => "a pattern over the load that repeats in every cycle.".to_string(),
            (_, false) => "a pattern over time that does not follow the load.".to_string(),
        };
        Self {
            share_of_variance: share,
            shape,
            over_time,
            description,
        }
    }
}

fn binned(x: &[f64], y: &[f64]) -> Vec<[f64; 2]> {
    let (low, high) = x
        .iter()
        .fold((f64::MAX, f64::MIN), |(l, h), v| (l.min(*v), h.max(*v)));
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
