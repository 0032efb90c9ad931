//! How the correction is found. A method is one function and one line in [`METHODS`].

use super::correction::Correction;
use super::mirror::mirror;
use super::near::near;
use super::online::{self, Sensor};
use super::remaining::Station;
use super::shifted::shifted;
use crate::ground::problem::Outcome;
use crate::ground::spatial::{V3, add};
use crate::planning::Plan;
use crate::process::run::Outcome as Milled;
use crate::process::setup::{Setup, Support};
use crate::process::way::{Way, normal_part};

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
    /// The motion that a corrected program makes.
    pub way_of: &'a (dyn Fn(&Correction) -> Outcome<Way> + Sync),
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

/// Finds the correction of a job by a method.
///
/// # Errors
/// As the runs.
pub fn search(method: &Method, task: &Task) -> Outcome<Search> {
    let none = Correction::none(task.plan.path.length);
    (method.find)(task, none)
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
                at: add(cut.tip, bent),
                left: normal_part(bent, Some(feed)),
                cutting: cut.cutting,
            })
        })
        .collect();
    let left = near(&stations).into_iter().map(|l| (l.s_m, l.left));
    correction.take(&left.collect::<Vec<_>>());
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
