//! Flat tops: a channel that stands at its extreme while the other goes on.

use super::{Course, Rule};
use crate::fit::suitability::{Said, Weight, extent, range};

/// The rule.
pub const RULE: Rule = Rule {
    name: "clipped",
    about: "A channel at the end of its range repeats one number while the other channel goes on.",
    remedy: "measure again with a wider range of that sensor, or load less",
    look,
};

/// Fewer equal readings in a row than this make no plateau.
const PLATEAU: usize = 4;
/// Share of its range by which the other channel goes on meanwhile.
const GOES_ON: f64 = 0.03;
/// Steps of the converter by which the other channel's change would have moved this one.
const STEPS: f64 = 4.0;

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
    say("load", clipped(&file.load, &on.deflection));
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
    let (low, high) = range(channel);
    let span = extent(other);
    let scale = span / (high - low);
    if !scale.is_finite() || scale <= 0.0 {
        return None;
    }
    let any = [high, low].map(|end| plateaus(channel, other, end, GOES_ON * span));
    if any.iter().all(|rows| *rows < PLATEAU) {
        return None;
    }
    let step = step(channel, high - low);
    let by = (GOES_ON * span).max(STEPS * step * scale);
    let at = |end: f64| plateaus(channel, other, end, by);
    let ends = [(at(high), "upper end"), (at(low), "lower end")];
    ends.into_iter()
        .max_by_key(|end| end.0)
        .filter(|end| end.0 >= PLATEAU)
}

/// Rows in plateaus at `end` during which the other channel goes on by at least `by`.
fn plateaus(channel: &[f64], other: &[f64], end: f64, by: f64) -> usize {
    let mut rows = 0;
    let mut start = None;
    for i in 0..=channel.len() {
        let here = channel.get(i).is_some_and(|v| *v == end);
        match (start, here) {
            (None, true) => start = Some(i),
            (Some(from), false) => {
                if i - from >= PLATEAU && extent(&other[from..i]) > by {
                    rows += i - from;
                }
                start = None;
            }
            _ => {}
        }
    }
    rows
}

/// Step of the converter: the smallest difference between neighbouring rows that differ.
fn step(channel: &[f64], extent: f64) -> f64 {
    let pairs = channel.windows(2).map(|w| (w[1] - w[0]).abs());
    let least = pairs
        .filter(|d| *d > 1e-9 * extent)
        .fold(f64::INFINITY, f64::min);
    if least.is_finite() { least } else { 0.0 }
}
