//! Runs of the job with the springs alone, as it is and with one thing changed: what a change does to the part,
//! the force giving way to it.

use super::stations::Station;
use crate::ground::problem::Outcome;
use crate::ground::spatial::{M3, V3, add, scale, sub};
use crate::process::Way;
use crate::process::setup::{Setup, Support};
use crate::process::way::Row;
use rayon::prelude::*;

/// What was tried, each a displacement of the tool at every station, workpiece frame.
pub(super) struct Tried {
    /// As it is, m.
    pub still: Vec<V3>,
    /// Change by each of the six coefficients, each doubled (linearised), m.
    pub coefficients: Vec<Vec<V3>>,
    /// How far the tool goes where it is moved by one: the cut gives way, or is deeper.
    pub answer: Vec<M3>,
    /// Change by a radius of the tool that is larger by one (linearised): it meets more material.
    pub larger: Vec<V3>,
}

/// Relative change at which coefficients are tried.
const CHANGED: f64 = 0.1;
/// Way by which the tool is moved, m.
const MOVED: f64 = 40e-6;
/// By how much the radius of the tool is larger, m.
const LARGER: f64 = 40e-6;
/// Coefficients: three of the cut, three of the edge.
const COEFFICIENTS: usize = 6;

/// Where the tool stands at every station, with springs alone, m.
///
/// # Errors
/// As a run of the job.
pub(super) fn still(setup: &Setup, stations: &[Station]) -> Outcome<Vec<V3>> {
    let (milled, _) = setup.run(Support::Static, |_| {})?;
    let at = |s: &Station| milled.deviation_at(s.time_s);
    Ok(stations.iter().map(at).collect())
}

/// Tries everything.
///
/// # Errors
/// As a run of the job.
pub(super) fn tried(setup: &Setup, stations: &[Station]) -> Outcome<Tried> {
    let run = |i: usize| match i {
        0 => still(setup, stations),
        i if i <= COEFFICIENTS => still(&stronger(setup, i - 1), stations),
        i if i <= COEFFICIENTS + 3 => still(&moved(setup, i - 1 - COEFFICIENTS), stations),
        _ => still(&larger(setup), stations),
    };
    let runs: Vec<Outcome<Vec<V3>>> = (0..=COEFFICIENTS + 4).into_par_iter().map(run).collect();
    let mut runs = runs.into_iter().collect::<Outcome<Vec<_>>>()?.into_iter();
    let still = runs.next().unwrap_or_default();
    let change = |run: Vec<V3>, by: f64| -> Vec<V3> {
        let pairs = run.iter().zip(&still);
        pairs.map(|(a, b)| scale(by.recip(), sub(*a, *b))).collect()
    };
    let mut changes = |count: usize, by: f64| -> Vec<Vec<V3>> {
        let own = runs.by_ref().take(count);
        own.map(|run| change(run, by)).collect()
    };
    let coefficients = changes(COEFFICIENTS, CHANGED);
    let moved = changes(3, MOVED);
    let larger = changes(1, LARGER).pop().unwrap_or_default();
    let answer = |s: usize| {
        let at = |row: usize, k: usize| f64::from(u8::from(row == k)) + moved[k][s][row];
        [0, 1, 2].map(|row| [0, 1, 2].map(|k| at(row, k)))
    };
    Ok(Tried {
        answer: (0..stations.len()).map(answer).collect(),
        coefficients,
        larger,
        still,
    })
}

fn stronger(setup: &Setup, coefficient: usize) -> Setup {
    let mut setup = setup.clone();
    setup.material.coefficients[coefficient] *= 1.0 + CHANGED;
    setup
}

fn larger(setup: &Setup) -> Setup {
    let mut setup = setup.clone();
    setup.tool.radius_m += LARGER;
    setup
}

/// The tool beside its way by a little, along one axis of the workpiece.
fn moved(setup: &Setup, k: usize) -> Setup {
    let aside: V3 = std::array::from_fn(|i| if i == k { MOVED } else { 0.0 });
    beside(setup, |_| aside)
}

/// The tool beside its way by so much (m) at every station, in between along straight lines over time.
pub(super) fn shifted(setup: &Setup, stations: &[Station], by: &[V3]) -> Setup {
    let mut known: Vec<(f64, V3)> = stations
        .iter()
        .map(|s| s.time_s)
        .zip(by.iter().copied())
        .collect();
    known.sort_by(|a, b| a.0.total_cmp(&b.0));
    let at = |time: f64| {
        let after = known.partition_point(|k| k.0 < time);
        let [a, b] = [after.saturating_sub(1), after.min(known.len() - 1)].map(|i| known[i]);
        let share = match b.0 > a.0 {
            true => ((time - a.0) / (b.0 - a.0)).clamp(0.0, 1.0),
            false => 0.0,
        };
        add(a.1, scale(share, sub(b.1, a.1)))
    };
    match known.is_empty() {
        true => setup.clone(),
        false => beside(setup, |row| at(row.time_s)),
    }
}

/// The tool beside its way.
fn beside(setup: &Setup, by: impl Fn(&Row) -> V3) -> Setup {
    let row = |row: &Row| Row {
        tip: add(row.tip, by(row)),
        ..row.clone()
    };
    let rows = setup.way.rows().iter().map(row).collect();
    let way = Way::new(rows).unwrap_or_else(|| setup.way.clone());
    Setup {
        way,
        ..setup.clone()
    }
}
