//! Runs of the job, with the springs alone or, where the robot swings, coupled in time, as it is and with one thing changed: what a
//! change does to the part, the force giving way to it.

use super::driven::Driven;
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

/// What a run leaves at every station, m.
///
/// # Errors
/// As a run of the job.
pub(super) fn left(setup: &Setup, stations: &[Station], support: Support) -> Outcome<Vec<V3>> {
    left_beside(setup, stations, support, |_| [0.0; 3])
}

/// The same of a tool that is moved beside its programmed way by so much (m) at every time (s).
///
/// # Errors
/// As a run of the job.
pub(super) fn left_beside(
    setup: &Setup,
    stations: &[Station],
    support: Support,
    by: impl Fn(f64) -> V3,
) -> Outcome<Vec<V3>> {
    left_along(setup, &Driven::as_told(&setup.way), (stations, support), by)
}

/// The same of a tool that is driven along another way.
///
/// # Errors
/// As a run of the job.
pub(super) fn left_along(
    setup: &Setup,
    driven: &Driven,
    (stations, support): (&[Station], Support),
    by: impl Fn(f64) -> V3,
) -> Outcome<Vec<V3>> {
    let way = beside(&driven.way, |row| by(row.time_s));
    let setup = Setup {
        way,
        ..setup.clone()
    };
    let (milled, _) = setup.run(support, |_| {})?;
    let off = |time: f64| add(milled.deviation_at(time), by(time));
    let tool = |time: f64| add(driven.way.at(time).tip, off(time));
    let left = |s: &Station| s.plane().passed_by(tool, (driven.when)(s));
    Ok(stations.iter().map(left).collect())
}

/// Tries everything.
///
/// # Errors
/// As a run of the job.
pub(super) fn tried(setup: &Setup, stations: &[Station], support: Support) -> Outcome<Tried> {
    let left = |setup: &Setup| left(setup, stations, support);
    let aside = |k: usize| std::array::from_fn(|i| if i == k { MOVED } else { 0.0 });
    let run = |i: usize| match i {
        0 => left(setup),
        i if i <= COEFFICIENTS => left(&stronger(setup, i - 1)),
        i if i <= COEFFICIENTS + 3 => {
            left_beside(setup, stations, support, |_| aside(i - 1 - COEFFICIENTS))
        }
        _ => left(&larger(setup)),
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
    let answer = |s: usize| [0, 1, 2].map(|row| [0, 1, 2].map(|k| moved[k][s][row]));
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

/// What is given at every station (m), in between along straight lines over time (s); `when` a station is passed.
pub(super) fn between(
    stations: &[Station],
    given: &[V3],
    when: &dyn Fn(&Station) -> f64,
) -> impl Fn(f64) -> V3 + use<> {
    let times = stations.iter().map(when);
    let mut known: Vec<(f64, V3)> = times.zip(given.iter().copied()).collect();
    known.sort_by(|a, b| a.0.total_cmp(&b.0));
    move |time: f64| {
        let after = known.partition_point(|k| k.0 < time);
        let [a, b] = [after.saturating_sub(1), after.min(known.len() - 1)].map(|i| known[i]);
        let share = match b.0 > a.0 {
            true => ((time - a.0) / (b.0 - a.0)).clamp(0.0, 1.0),
            false => 0.0,
        };
        add(a.1, scale(share, sub(b.1, a.1)))
    }
}

/// A way with the tool beside it.
fn beside(way: &Way, by: impl Fn(&Row) -> V3) -> Way {
    let row = |row: &Row| Row {
        tip: add(row.tip, by(row)),
        ..row.clone()
    };
    let rows = way.rows().iter().map(row).collect();
    Way::new(rows).unwrap_or_else(|| way.clone())
}
