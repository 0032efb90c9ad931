//! A sensor at the end of its range.

use super::{Loaded, Rule};
use crate::fit::force_steps::Setup;
use crate::fit::suitability::{Said, Weight, extent, range};
use crate::measurement::workspace_test::{DIRECTIONS, Step};

/// A sensor at the end of its range repeats one number at different forces.
pub const RULE: Rule = Rule {
    name: "clipped",
    remedy: "measure again with a wider range of that sensor, or with less force",
    look,
};

/// Readings at one extreme that are no coincidence.
const PLATEAU: usize = 4;
/// Share of all distinct readings that is no coincidence of a coarse converter.
const LEVELS: usize = 5;

fn look(on: &Loaded) -> Said {
    let steps = &on.test.steps;
    let mut found = Vec::new();
    for (k, name) in DIRECTIONS.iter().enumerate() {
        let values: Vec<f64> = steps.iter().map(|s| s.displacement[k]).collect();
        let (low, high) = range(&values);
        let rows = [low, high]
            .map(|end| at(steps, k, end))
            .into_iter()
            .max()
            .unwrap_or(0);
        let mut levels: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
        levels.sort_by(f64::total_cmp);
        let inner = levels.chunk_by(|a, b| a == b);
        let typical = inner
            .filter(|same| same[0] != low && same[0] != high)
            .map(<[f64]>::len)
            .max();
        let stands = rows >= PLATEAU && rows >= LEVELS * typical.unwrap_or(1).min(rows);
        if high > low && stands {
            let what = format!(
                "the displacement d{name} stands at its extreme in {rows} steps of different force: it is clipped"
            );
            found.push((Weight::Fatal, what));
        }
    }
    found.extend(force(on));
    found
}

/// Share of a set-up's displacement that the steps at one extreme of its force may span ...
const SPANNED: f64 = 0.05;
/// ... and how many times what they span at the other forces: a loop is widest in its middle.
const LOOP: f64 = 3.0;

/// A force that stands at its extreme while the displacement goes on, in most set-ups.
fn force(on: &Loaded) -> Option<(Weight, String)> {
    let some = on.setups.iter().take(ENOUGH);
    let count = some.clone().filter(|setup| stands(on, setup)).count();
    (count > 0 && 2 * count > some.len()).then(|| {
        let what = "the force stands at its extreme while the displacement goes on: it is clipped";
        (Weight::Fatal, what.to_string())
    })
}

fn stands(on: &Loaded, setup: &Setup) -> bool {
    let own = |s: &&Step| s.point == setup.point && s.direction == setup.direction;
    let mut steps: Vec<(f64, f64)> = on
        .test
        .steps
        .iter()
        .filter(own)
        .map(|s| (s.force, s.displacement[setup.direction]))
        .filter(|(force, moved)| force.is_finite() && moved.is_finite())
        .collect();
    steps.sort_by(|a, b| a.0.total_cmp(&b.0));
    let moved = |steps: &[(f64, f64)]| extent(&steps.iter().map(|s| s.1).collect::<Vec<_>>());
    let levels: Vec<&[(f64, f64)]> = steps.chunk_by(|a, b| a.0 == b.0).collect();
    let [first, inner @ .., last] = &levels[..] else {
        return false;
    };
    let widest = inner.iter().map(|level| moved(level)).fold(0.0, f64::max);
    let largest = first[0].0.abs().max(last[0].0.abs());
    let limit = (LOOP * widest).max(SPANNED * moved(&steps));
    let flat = |end: &[(f64, f64)], other: &[(f64, f64)]| {
        let limit = match inner.iter().all(|level| level.len() > 1) {
            true => limit.max(SCATTER * repeated(inner, other)),
            false => limit,
        };
        end.len() >= PLATEAU && end[0].0.abs() > 0.5 * largest && moved(end) > limit
    };
    flat(first, last) || flat(last, first)
}

/// Scatter at one force, between the extremes; with the other extreme, which may be clipped as well, only where those are too few.
fn repeated(inner: &[&[(f64, f64)]], other: &[(f64, f64)]) -> f64 {
    let own = scatter(inner.iter().copied());
    match own.is_finite() {
        true => own,
        false => scatter(inner.iter().copied().chain([other])),
    }
}

/// Standard deviation of displacements about the mean at their force, where every force was set several times, as by
/// weights; infinite with too few readings to tell.
fn scatter<'a>(levels: impl Iterator<Item = &'a [(f64, f64)]>) -> f64 {
    let (mut squares, mut freedom) = (0.0, 0);
    for level in levels {
        let mean = level.iter().map(|s| s.1).sum::<f64>() / level.len() as f64;
        squares += level.iter().map(|s| (s.1 - mean).powi(2)).sum::<f64>();
        freedom += level.len() - 1;
    }
    match freedom >= PLATEAU {
        true => (squares / freedom as f64).sqrt(),
        false => f64::INFINITY,
    }
}

/// How many standard deviations readings at one force may span.
const SCATTER: f64 = 6.0;

/// Set-ups that tell whether the force is clipped.
const ENOUGH: usize = 60;

/// Steps at an extreme, where they are of different force or set-up.
fn at(steps: &[Step], k: usize, end: f64) -> usize {
    let own: Vec<&Step> = steps.iter().filter(|s| s.displacement[k] == end).collect();
    let forces: Vec<f64> = own.iter().map(|s| s.force.abs()).collect();
    let all: Vec<f64> = steps.iter().map(|s| s.force.abs()).collect();
    match extent(&forces) > 0.1 * extent(&all) {
        true => own.len(),
        false => 0,
    }
}
