//! How the correction is found. A method is one function and one line in [`METHODS`].

use super::correction::Correction;
use super::remaining::{Size, Station, remaining};
use super::shifted::shifted;
use crate::ground::problem::Outcome;
use crate::ground::spatial::{V3, norm, scale};
use crate::planning::Plan;
use crate::process::run::Outcome as Milled;
use crate::process::setup::{Setup, Support};
use crate::process::way::normal_part;

/// A way to find the correction.
pub struct Method {
    /// Its name.
    pub name: &'static str,
    /// What it does, one sentence.
    pub about: &'static str,
    find: fn(&Setup, &Plan, Correction) -> Outcome<Search>,
}

/// Every method; the first is the usual one.
pub const METHODS: &[Method] = &[
    Method {
        name: "mirror",
        about: "mirrors what the simulation leaves, again and again until nothing changes",
        find: mirror,
    },
    Method {
        name: "ideal-force",
        about: "takes the deflection under the forces of the undisturbed cut away, once",
        find: ideal_force,
    },
];

/// A correction as it was found.
#[derive(Debug, Clone)]
pub struct Search {
    /// The correction.
    pub correction: Correction,
    /// How often the part was milled for it.
    pub iterations: usize,
    /// Whether it no longer changes.
    pub converged: bool,
    /// Largest change of the last iteration, m.
    pub last_change_m: f64,
}

/// Most iterations of the mirror.
const ITERATIONS: usize = 12;
/// Change of the correction, against the largest deviation, at which it stands still.
const STILL: f64 = 1e-2;
/// How far before and behind the cut the correction is carried on fully, and fades, m.
const CARRIED: f64 = 2e-3;
const FADES: f64 = 12e-3;

/// Finds the correction of a job by a method.
///
/// # Errors
/// As the runs.
pub fn search(method: &Method, setup: &Setup, plan: &Plan) -> Outcome<Search> {
    let none = Correction::none(plan.path.length);
    (method.find)(setup, plan, none)
}

/// What springs leave of the deviation is mirrored (source 004): swings are not, a correction at the
/// pace of a mode would feed it.
fn mirror(setup: &Setup, plan: &Plan, mut correction: Correction) -> Outcome<Search> {
    let (mut change, mut first) = (f64::INFINITY, 0.0);
    for iterations in 1..=ITERATIONS {
        let (milled, _) = with(setup, plan, &correction)?.run(Support::Static, |_| {})?;
        let stations = remaining(&milled, &correction, &setup.way);
        if iterations == 1 {
            first = Size::of(&stations).max_m;
        }
        let before = correction.clone();
        correction.take(&windowed(&stations), 1.0);
        change = correction.farthest(&before);
        if change <= STILL * first {
            return Ok(Search {
                correction,
                iterations,
                converged: true,
                last_change_m: change,
            });
        }
    }
    Ok(Search {
        correction,
        iterations: ITERATIONS,
        converged: false,
        last_change_m: change,
    })
}

/// Compliance times the force of a tool that nothing moves (source 004): no feedback on the cut.
fn ideal_force(setup: &Setup, plan: &Plan, mut correction: Correction) -> Outcome<Search> {
    let (rigid, _) = setup.run(Support::Rigid, |_| {})?;
    let bent = bent(setup, &rigid)?;
    let stations: Vec<Station> = rigid
        .course
        .iter()
        .zip(bent)
        .filter_map(|(cut, bent)| {
            let feed = setup.way.feed(cut.time_s)?;
            Some(Station {
                time_s: cut.time_s,
                s_m: cut.s_m,
                left: normal_part(bent, Some(feed)),
                cutting: cut.cutting,
            })
        })
        .collect();
    let _ = plan;
    correction.take(&windowed(&stations), 1.0);
    let last_change_m = correction.largest().0;
    Ok(Search {
        correction,
        iterations: 1,
        converged: true,
        last_change_m,
    })
}

/// Deflection of the springs under the forces of a course, m.
fn bent(setup: &Setup, milled: &Milled) -> Outcome<Vec<V3>> {
    let mut springs = setup.springs()?;
    let cuts = milled.course.iter();
    cuts.map(|cut| springs.bent(&setup.way.at(cut.time_s), cut.force))
        .collect()
}

/// The job with its path corrected.
///
/// # Errors
/// A place that the robot no longer reaches.
pub fn with(setup: &Setup, plan: &Plan, correction: &Correction) -> Outcome<Setup> {
    Ok(Setup {
        way: shifted(plan, correction)?,
        ..setup.clone()
    })
}

/// What is left at ascending arc lengths, fading away from the cut.
fn windowed(stations: &[Station]) -> Vec<(f64, V3)> {
    let mut ascending: Vec<(f64, V3)> = Vec::new();
    let cuts: Vec<f64> = stations
        .iter()
        .filter(|s| s.cutting)
        .map(|s| s.s_m)
        .collect();
    for station in stations {
        if ascending.last().is_none_or(|last| station.s_m > last.0) {
            let window = window(distance(&cuts, station.s_m));
            ascending.push((station.s_m, scale(window, station.left)));
        }
    }
    ascending
}

/// Distance to the nearest of ascending places.
fn distance(places: &[f64], s: f64) -> f64 {
    let after = places.partition_point(|p| *p < s);
    let near = [after.checked_sub(1), Some(after)].into_iter().flatten();
    let near = near.filter_map(|i| places.get(i));
    near.map(|p| (p - s).abs()).fold(f64::INFINITY, f64::min)
}

fn window(distance: f64) -> f64 {
    let x = ((distance - CARRIED) / FADES).clamp(0.0, 1.0);
    1.0 - x * x * (3.0 - 2.0 * x)
}

/// Largest length in a list, m.
pub fn largest(all: &[V3]) -> f64 {
    all.iter().map(|v| norm(*v)).fold(0.0, f64::max)
}
