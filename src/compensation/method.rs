//! How the correction is found. A method is one function and one line in [`METHODS`].

use super::answering::{STEP_S, command};
use super::correction::Correction;
use super::online::{self, Sensor};
use super::remaining::{Size, Station, remaining};
use super::shifted::shifted;
use crate::ground::problem::Outcome;
use crate::ground::spatial::{V3, add, scale, sub};
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
    /// Whether the robot is corrected while it cuts: its program stays as it was.
    pub live: bool,
    /// The method that it improves on, shown beside it.
    pub beside: Option<&'static str>,
    find: fn(&Task, Correction) -> Outcome<Search>,
}

/// Every method; the first is the usual one.
pub const METHODS: &[Method] = &[
    Method {
        name: "mirror",
        about: "mirrors what the simulation leaves, again and again until nothing changes",
        live: false,
        beside: None,
        find: mirror,
    },
    Method {
        name: "ideal-force",
        about: "takes the deflection under the forces of the undisturbed cut away, once",
        live: false,
        beside: None,
        find: ideal_force,
    },
    Method {
        name: "hybrid",
        about: "measures the force while cutting, and trusts the simulated one where it turns: at exits",
        live: true,
        beside: Some("online"),
        find: online::hybrid,
    },
    Method {
        name: "online",
        about: "measures the force while cutting, 100 to 150 ms late",
        live: true,
        beside: None,
        find: online::online,
    },
];

/// What is to be corrected.
#[derive(Clone, Copy)]
pub struct Task<'a> {
    /// The model.
    pub setup: &'a Setup,
    /// What is really cut: another robot or material where one is known, else the model.
    pub truth: &'a Setup,
    /// The programmed motion.
    pub plan: &'a Plan,
    /// What the mirror learns from: springs, or robot and cut in time.
    pub support: Support,
    /// The force sensor of a correction while cutting.
    pub sensor: Sensor,
}

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
const ITERATIONS: usize = 10;
/// Change of the correction, against the largest deviation, at which it stands still.
const STILL: f64 = 1e-2;
/// The same where it is said that the mirror has converged: swings never stand quite still.
const SETTLED: f64 = 5e-2;
/// An iteration that lowers the largest deviation by less than this share gains nothing ...
const GAIN: f64 = 0.03;
/// ... and after so many of them the best is kept.
const PATIENCE: usize = 2;
/// Share of what is left that is taken away at once where masses swing.
const CAREFUL: f64 = 0.9;
/// How far before and behind the cut the correction is carried on fully, and fades, m: springs ...
const CARRIED: f64 = 2e-3;
const FADES: f64 = 12e-3;
/// ... and how long before and behind it, s, where masses swing: a few periods of a soft robot.
const AHEAD_S: [f64; 2] = [0.6, 0.4];
const BEHIND_S: [f64; 2] = [0.05, 0.2];

/// Finds the correction of a job by a method.
///
/// # Errors
/// As the runs.
pub fn search(method: &Method, task: &Task) -> Outcome<Search> {
    let none = Correction::none(task.plan.path.length);
    (method.find)(task, none)
}

/// What the simulation leaves is mirrored (source 004): straight where springs alone carry the tool; where
/// robot and cut are coupled in time, through the inverse of how the tip answers a command. The best of
/// the corrections is kept.
fn mirror(task: &Task, mut correction: Correction) -> Outcome<Search> {
    let (mut first, mut idle) = (None, 0);
    let mut best = (f64::INFINITY, correction.clone());
    let mut last_change_m = f64::INFINITY;
    for iterations in 1..=ITERATIONS {
        let job = with(task.setup, task.plan, &correction)?;
        let (milled, _) = job.run(task.support, |_| {})?;
        let stations = remaining(&milled, &correction, &task.setup.way);
        let left = Size::of(&stations).max_m;
        let first = *first.get_or_insert(left);
        idle = if left < (1.0 - GAIN) * best.0 {
            0
        } else {
            idle + 1
        };
        if left < best.0 {
            best = (left, correction.clone());
        }
        let still = last_change_m <= STILL * first;
        if still || idle >= PATIENCE || iterations == ITERATIONS {
            return Ok(Search {
                correction: best.1,
                iterations,
                converged: last_change_m <= SETTLED * first,
                last_change_m,
            });
        }
        let before = correction.clone();
        let update = update(task, &stations)?;
        correction.take(&update, 1.0);
        last_change_m = correction.farthest(&before);
    }
    unreachable!("the last iteration returns")
}

/// What is to be taken away at ascending arc lengths.
fn update(task: &Task, stations: &[Station]) -> Outcome<Vec<(f64, V3)>> {
    if task.support != Support::Coupled {
        return Ok(near(stations).iter().map(|l| (l.s_m, l.left)).collect());
    }
    let left = before_and_in(stations);
    let way = &task.setup.way;
    let [begin, end] = way.span();
    let count = ((end - begin) / STEP_S).ceil() as usize + 1;
    let times = (0..count).map(|i| begin + STEP_S * i as f64);
    let wanted: Vec<V3> = times.clone().map(|t| at(&left, t)).collect();
    let told = command(task.setup, &task.plan.cell.chain, &wanted)?;
    let mut update: Vec<(f64, V3)> = Vec::new();
    for (time, told) in times.zip(told) {
        let s = way.at(time).s_m;
        if update.last().is_none_or(|last| s > last.0) {
            let normal = normal_part(told, way.feed(time));
            update.push((s, scale(CAREFUL, normal)));
        }
    }
    Ok(update)
}

/// What is left at one time.
#[derive(Debug, Clone, Copy)]
struct Left {
    time_s: f64,
    s_m: f64,
    left: V3,
}

/// Linear between stations, nothing outside.
fn at(left: &[Left], time_s: f64) -> V3 {
    let after = left.partition_point(|l| l.time_s < time_s);
    let (Some(a), Some(b)) = (
        after.checked_sub(1).and_then(|i| left.get(i)),
        left.get(after),
    ) else {
        return [0.0; 3];
    };
    let share = (time_s - a.time_s) / (b.time_s - a.time_s);
    add(a.left, scale(share, sub(b.left, a.left)))
}

/// Compliance times the force of a tool that nothing moves (source 004): no feedback on the cut.
fn ideal_force(task: &Task, mut correction: Correction) -> Outcome<Search> {
    let setup = task.setup;
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
                tip: cut.tip,
                left: normal_part(bent, Some(feed)),
                cutting: cut.cutting,
            })
        })
        .collect();
    let left = near(&stations).into_iter().map(|l| (l.s_m, l.left));
    correction.take(&left.collect::<Vec<_>>(), 1.0);
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
fn windowed(stations: &[Station], weight: &dyn Fn(&Station) -> f64) -> Vec<Left> {
    let mut ascending: Vec<Left> = Vec::new();
    for station in stations {
        if ascending.last().is_none_or(|last| station.s_m > last.s_m) {
            ascending.push(Left {
                time_s: station.time_s,
                s_m: station.s_m,
                left: scale(weight(station), station.left),
            });
        }
    }
    ascending
}

/// Springs: everything within millimetres of the cut.
fn near(stations: &[Station]) -> Vec<Left> {
    let cuts: Vec<f64> = of_cuts(stations, |s| s.s_m);
    windowed(stations, &|station| {
        faded(distance(&cuts, station.s_m), CARRIED, FADES)
    })
}

/// Masses: a swing that the way to the cut has set going is taken away before it gets there.
fn before_and_in(stations: &[Station]) -> Vec<Left> {
    let cuts: Vec<f64> = of_cuts(stations, |s| s.time_s);
    windowed(stations, &|station| {
        let next = cuts.partition_point(|t| *t < station.time_s);
        let ahead = cuts.get(next).map_or(f64::INFINITY, |t| t - station.time_s);
        let last = next.checked_sub(1).map(|i| station.time_s - cuts[i]);
        let ahead = faded(ahead, AHEAD_S[0], AHEAD_S[1]);
        let behind = faded(last.unwrap_or(f64::INFINITY), BEHIND_S[0], BEHIND_S[1]);
        ahead.max(behind)
    })
}

fn of_cuts(stations: &[Station], value: fn(&Station) -> f64) -> Vec<f64> {
    let cutting = stations.iter().filter(|s| s.cutting);
    cutting.map(value).collect()
}

/// Distance to the nearest of ascending places.
fn distance(places: &[f64], s: f64) -> f64 {
    let after = places.partition_point(|p| *p < s);
    let near = [after.checked_sub(1), Some(after)].into_iter().flatten();
    let near = near.filter_map(|i| places.get(i));
    near.map(|p| (p - s).abs()).fold(f64::INFINITY, f64::min)
}

/// 1 up to a distance, then falling to 0 over a length.
fn faded(distance: f64, full: f64, falls: f64) -> f64 {
    let x = ((distance - full) / falls).clamp(0.0, 1.0);
    1.0 - x * x * (3.0 - 2.0 * x)
}
