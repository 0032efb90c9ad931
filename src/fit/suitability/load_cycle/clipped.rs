//! Flat tops: a channel that stands at its extreme while the other goes on.

use super::{Course, Rule};
use crate::fit::suitability::{Said, Weight, extent, range};
use crate::ground::stats::mean;
use crate::signal::outliers;
use std::ops::Range;

/// A channel at the end of its range repeats one number while the other channel goes on.
pub const RULE: Rule = Rule {
    name: "clipped",
    remedy: "measure again with a wider range of that sensor, or load less",
    look,
};

/// Fewer equal readings in a row than this make no plateau.
const PLATEAU: usize = 4;
/// Share of its range by which the other channel goes on meanwhile.
const GOES_ON: f64 = 0.03;
/// Steps of the converter by which the other channel's change would have moved this one.
const STEPS: f64 = 4.0;

/// Deviations of a reading of the other channel by which it must go on: the readings of a plateau are some three apart by chance, six in a burst.
const BEYOND_NOISE: f64 = 8.0;
/// Rows before and behind a plateau that tell the noise there.
const NEAR: usize = 20;
/// Share of the rows that stand on plateaus between the ends of a load that somebody holds: weights, a
/// commanded staircase.
const STAIRS: f64 = 0.2;
/// A load within this share of its range from zero is none, and a cell that cannot show the other sign hides
/// at least this share of the deflection.
const ZERO: f64 = 0.005;
const HIDDEN: f64 = 0.2;
/// Least share of all that the other channel does over a plateau by which its middle third is beyond both
/// outer ones, where it goes out and back: half of it for a triangle.
const HILL: f64 = 0.2;

fn look(on: &Course) -> Said {
    let file = on.file;
    let mut found = Vec::new();
    let mut say = |channel: &str, end: Option<(usize, &str)>| {
        let said = |(rows, end): (usize, &str)| {
            let what = format!(
                "the {channel} stands at its {end} for {rows} rows while the test goes on: it is clipped"
            );
            (Weight::Fatal, what)
        };
        found.extend(end.map(said));
    };
    say("deflection", clipped(&on.deflection, &file.load));
    let (slope, least) = (on.relation.slope.signum(), HIDDEN * extent(&on.deflection));
    let at_zero = |end: f64| end.abs() < ZERO * extent(&file.load);
    let (low, high) = range(&file.load);
    let held = |rows: &[f64], side: f64| {
        let end = if side > 0.0 { high } else { low };
        is_held(rows, side * slope) || at_zero(end) && extent(rows) < least
    };
    let load = match is_commanded(&file.load) {
        true => None,
        false => clipped_but(&file.load, &on.deflection, held),
    };
    say("load", load);
    if let Some(second) = &file.second {
        let end = clipped(second, &file.load);
        let what = |(rows, end): (usize, &str)| {
            format!(
                "the second deflection stands at its {end} for {rows} rows while the test goes on: it is clipped"
            )
        };
        found.extend(end.map(|end| (Weight::Odd, what(end))));
    }
    found
}

/// Rows that stand at an extreme while the other channel goes on, and at which.
pub fn clipped(channel: &[f64], other: &[f64]) -> Option<(usize, &'static str)> {
    clipped_but(channel, other, |_, _| false)
}

/// The same without the plateaus of which something says that they were held: by the other channel's
/// readings there, and the side of the end, +1 or −1.
fn clipped_but(
    channel: &[f64],
    other: &[f64],
    held: impl Fn(&[f64], f64) -> bool,
) -> Option<(usize, &'static str)> {
    let (low, high) = range(channel);
    let span = extent(other);
    let scale = span / (high - low);
    if !scale.is_finite() || scale <= 0.0 {
        return None;
    }
    let rows = |end: f64, by: f64| {
        let side = if end == high { 1.0 } else { -1.0 };
        plateaus(channel, end, |own| {
            let goes_on = extent(&other[own.clone()]);
            goes_on > by
                && goes_on > BEYOND_NOISE * scatter(other, &own)
                && !held(&other[own], side)
        })
    };
    let any = [high, low].map(|end| rows(end, GOES_ON * span));
    if any.iter().all(|rows| *rows < PLATEAU) {
        return None;
    }
    let step = step(channel, high - low);
    let by = (GOES_ON * span).max(STEPS * step * scale);
    let ends = [(rows(high, by), "upper end"), (rows(low, by), "lower end")];
    ends.into_iter()
        .max_by_key(|end| end.0)
        .filter(|end| end.0 >= PLATEAU)
}

/// Rows in plateaus at `end` that count.
fn plateaus(channel: &[f64], end: f64, counts: impl Fn(Range<usize>) -> bool) -> usize {
    let own = runs(channel).filter(|run| channel[run.start] == end && counts(run.clone()));
    own.map(|run| run.len()).sum()
}

/// Runs of equal readings long enough to be plateaus.
fn runs(channel: &[f64]) -> impl Iterator<Item = Range<usize>> {
    let mut from = 0;
    let all = channel.chunk_by(|a, b| a == b).map(move |run| {
        from += run.len();
        from - run.len()..from
    });
    all.filter(|run| run.len() >= PLATEAU)
}

/// Whether a load stands between its ends as well: nothing clips there.
fn is_commanded(load: &[f64]) -> bool {
    let (low, high) = range(load);
    let between = runs(load).filter(|run| load[run.start] > low && load[run.start] < high);
    between.map(|run| run.len()).sum::<usize>() as f64 > STAIRS * load.len() as f64
}

/// Whether the other channel does not go out and come back while this one stands: behind a clipped top there
/// is a hill, while a load is held there is creep, drift and noise.
fn is_held(other: &[f64], outward: f64) -> bool {
    let third = other.len() / 3;
    let part = |k: usize| mean(&other[k * third..(k + 1) * third]);
    let back = other.len() - third;
    let ends = [part(0), mean(&other[back..])];
    let hill = ends.map(|end| outward * (part(1) - end));
    hill[0].min(hill[1]) < HILL * extent(other)
}

/// Deviation of a reading about some rows.
fn scatter(readings: &[f64], own: &Range<usize>) -> f64 {
    let near = own.start.saturating_sub(NEAR)..(own.end + NEAR).min(readings.len());
    outliers::robust_std(&outliers::third_differences(&readings[near]))
}

/// Step of the converter: the smallest difference between neighbouring rows that differ.
fn step(channel: &[f64], extent: f64) -> f64 {
    let pairs = channel.windows(2).map(|w| (w[1] - w[0]).abs());
    let least = pairs
        .filter(|d| *d > 1e-9 * extent)
        .fold(f64::INFINITY, f64::min);
    if least.is_finite() { least } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A sine of the load with creep behind it.
    fn cycles(load: impl Fn(f64) -> f64) -> (Vec<f64>, Vec<f64>) {
        let at = |i: usize| load((i as f64 * 0.03).sin());
        let loads: Vec<f64> = (0..800).map(at).collect();
        let mut late = 0.0;
        let creeping = |load: &f64| {
            late += 0.04 * (load - late);
            load + 0.3 * late
        };
        let deflections = loads.iter().map(creeping).collect();
        (loads, deflections)
    }

    fn look(load: &[f64], deflection: &[f64]) -> bool {
        let held = |rows: &[f64], side: f64| is_held(rows, side);
        !is_commanded(load) && clipped_but(load, deflection, held).is_some()
    }

    #[test]
    fn a_load_that_is_held_while_the_joint_creeps_is_not_clipped() {
        for load in [|s: f64| s.max(0.0), |s: f64| s.clamp(-0.6, 0.6)] {
            let (load, deflection) = cycles(load);
            assert!(clipped(&load, &deflection).is_some());
            assert!(!look(&load, &deflection));
        }
    }

    /// The top of a sine that is read in steps stands for some readings, while the deflection scatters.
    #[test]
    fn a_coarse_load_beside_bursts_of_noise_is_not_clipped() {
        let mut random = crate::ground::random::Random::new(5);
        let load: Vec<f64> = (0..1100)
            .map(|i| ((i as f64 * 0.03).sin() * 100.0).round() / 100.0)
            .collect();
        let burst = |i: usize| {
            if (i / 100).is_multiple_of(3) {
                0.05
            } else {
                0.012
            }
        };
        let each = load.iter().enumerate();
        let deflection: Vec<f64> = each.map(|(i, l)| l + burst(i) * random.normal()).collect();
        assert!(!look(&load, &deflection));
    }

    #[test]
    fn a_load_cell_at_its_end_is_clipped() {
        let (load, deflection) = cycles(|s| s);
        let cut: Vec<f64> = load.iter().map(|l| l.clamp(-0.7, 0.8)).collect();
        assert!(look(&cut, &deflection));
    }

    #[test]
    fn a_sensor_at_its_end_is_clipped_under_weights_and_few_rows() {
        let level = |i: usize| (50.0 - (i / 12) as f64).abs().mul_add(-0.02, 1.0);
        let stairs: Vec<f64> = (0..1212).map(level).collect();
        let sine: Vec<f64> = (0..200).map(|i| (f64::from(i) * 0.2).sin()).collect();
        for load in [stairs, sine] {
            let cut: Vec<f64> = load.iter().map(|l| l.min(0.7)).collect();
            assert!(clipped(&cut, &load).is_some());
        }
    }
}
