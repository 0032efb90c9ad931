//! The force must repeat with the spindle.

use super::{Cutting, Rule};
use crate::fit::suitability::{Said, Weight};
use crate::ground::stats::{mean, rms};
use crate::measurement::milling_force::Record;
use std::f64::consts::TAU;

/// A cutting force repeats with every turn of the spindle; noise and other channels do not.
pub const RULE: Rule = Rule {
    name: "unrelated",
    remedy: "check which channel was recorded in this column, the time column and the spindle speed",
    look,
};

/// Correlation of a force with itself one turn on, below which it does not repeat.
const ALIKE: f64 = 0.3;
/// Error of a spindle speed that still passes for the stated one.
const SPEED: f64 = 0.02;
/// Turns that a record needs to tell.
const TURNS: f64 = 2.5;
/// Samples that are looked at.
const SAMPLES: usize = 20_000;
/// A force whose mean is above so many times its scatter is steady: three teeth and more in a full slot add up to one, and
/// nothing is there to repeat. A ramp, which is no cutting force, has 1.7; no other value was tried.
const STEADY: f64 = 3.0;
/// Times the stated noise that a channel along the axis must scatter about its mean in a cut to be judged by it: a helix evens out
/// its ripple in a full slot. Were the noise twice the stated one, what repeats would still be correlated by more than [`ALIKE`].
const SEEN: f64 = 2.5;

fn look(on: &Cutting) -> Said {
    let mut found = Vec::new();
    for (k, channel) in on.channels.iter().enumerate() {
        let seen = on
            .cuts()
            .filter(|(_, record)| k < 2 || on.changes(record, k));
        let cuts: Vec<f64> = seen
            .filter_map(|(cut, record)| repeats(record, k, TAU / cut.spindle_rad_s))
            .collect();
        let best = cuts.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        if !cuts.is_empty() && best < ALIKE {
            let what = format!(
                "{} does not repeat with the stated spindle speed in any cut",
                channel.name
            );
            found.push((Weight::Fatal, what));
        }
    }
    found
}

impl Cutting<'_> {
    /// Whether a channel changes by more than the stated noise in a cut, if one is stated.
    fn changes(&self, record: &Record, k: usize) -> bool {
        let own: Vec<f64> = record.force.iter().map(|f| f[k]).collect();
        let middle = mean(&own);
        let scatter = rms(&own.iter().map(|x| x - middle).collect::<Vec<_>>());
        let noise = self.file.facts.sensor_noise_n;
        noise.is_some_and(|noise| scatter > SEEN * noise)
    }
}

/// Largest correlation of a channel with itself about one turn on; none where the record is too short or the force steady.
fn repeats(record: &Record, k: usize, turn: f64) -> Option<f64> {
    let n = record.time.len().min(SAMPLES);
    let step = (record.time[n - 1] - record.time[0]) / (n - 1) as f64;
    let lag = turn / step;
    if !(lag.is_finite() && lag >= 4.0 && n as f64 > TURNS * lag) {
        return None;
    }
    let middle = record.force[..n].iter().map(|f| f[k]).sum::<f64>() / n as f64;
    let own: Vec<f64> = record.force[..n].iter().map(|f| f[k] - middle).collect();
    let scatter = (own.iter().map(|x| x * x).sum::<f64>() / n as f64).sqrt();
    if middle.abs() > STEADY * scatter {
        return None;
    }
    let (from, to) = (
        ((1.0 - SPEED) * lag) as usize,
        ((1.0 + SPEED) * lag) as usize + 1,
    );
    let stride = ((to - from) / 64).max(1);
    let at = |lag: usize| {
        let (a, b) = (&own[..n - lag], &own[lag..]);
        let product: f64 = a.iter().zip(b).map(|(a, b)| a * b).sum();
        let size = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>();
        product / (size(a) * size(b)).sqrt().max(f64::MIN_POSITIVE)
    };
    (from..=to).step_by(stride).map(at).reduce(f64::max)
}
