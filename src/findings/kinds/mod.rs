//! The kinds of measurement that can be diagnosed. A new kind is one file here and one line in [`KINDS`]:
//! what it measured and its figures ([`Measured`]) around an experiment of [`crate::findings::engine`].

mod cubes;
mod examined;
mod force_sensor;
mod hammer;
mod hammer_figures;
mod joint_motion;
mod known;
pub mod load_cycle;
mod milled_part;
mod milling_force;
mod present;
mod screw;
mod workspace;
mod workspace_figures;

pub use examined::{Measured, examined, found_of};
pub use known::{Known, Table, known};

use crate::findings::belief::Belief;
use crate::findings::{self, Answer};
use crate::ground::problem::Outcome;
use crate::measurement::hammer_uff::is_universal;
use crate::measurement::leading::front_of;
use crate::measurement::test::{Kind, Test};
use crate::robot::Robot;
use crate::sheet::chart::Chart;
use known::{of, of_all};
use serde_json::{Map, Value};
use std::path::Path;

/// Where an answer comes from.
#[derive(Debug, Clone, Copy)]
pub struct Source<'a> {
    /// The measurement file.
    pub path: &'a Path,
    /// Its hash.
    pub sha256: &'a str,
    /// Simulated, not measured.
    pub synthetic: bool,
}

impl<'a> Source<'a> {
    /// A file with its hash.
    pub fn new(path: &'a Path, sha256: &'a str, synthetic: bool) -> Self {
        Self {
            path,
            sha256,
            synthetic,
        }
    }

    /// Of a file whose rows are single readings.
    pub fn of<F: Kind>(test: &'a Test<F>, synthetic: bool) -> Self {
        Self::new(&test.path, &test.sha256, synthetic)
    }
}

/// A diagnosed measurement, as the verb prints and draws it.
pub trait Diagnosed: Send + Sync {
    /// The answer.
    fn answer(&self) -> &Answer;
    /// Where it comes from.
    fn source(&self) -> Source<'_>;
    /// What was measured, as `A6 of kr210`.
    fn about(&self) -> String;
    /// The present simulation, where it came from elsewhere than the file: one sentence.
    fn present(&self) -> Option<String> {
        None
    }
    /// Figures of what was measured and simulated.
    fn before_and_after(&self) -> Vec<Chart>;
    /// Figures of what no named cause explains.
    fn remaining(&self) -> Vec<Chart>;
    /// The extended model as a file; `None` where nothing was extended.
    fn model(&self) -> Outcome<Option<String>>;
    /// The robot it was simulated with, for tests of the whole robot.
    fn robot(&self) -> Option<&Robot> {
        None
    }
    /// That robot with the physical causes that were found.
    fn extended(&self) -> Option<&Robot> {
        None
    }
    /// The same measurement diagnosed with another robot.
    fn under(&self, _robot: &Robot) -> Option<Box<dyn Diagnosed>> {
        None
    }
    /// What it believes about the robot as a whole; `None` for what says nothing about it, or what no known
    /// cause explains.
    fn belief(&self) -> Option<&Belief> {
        None
    }
    /// What a reader should know beside the causes, one sentence each.
    fn remarks(&self) -> Vec<String> {
        Vec::new()
    }
    /// What this measurement could not have shown: one sentence.
    fn unseen(&self) -> Option<String> {
        None
    }
    /// What this kind adds to the common JSON.
    fn more(&self) -> Map<String, Value> {
        Map::new()
    }
}

/// Reads and diagnoses a file.
pub type Diagnose = fn(&Path) -> Outcome<Box<dyn Diagnosed>>;

/// Every kind: its name in the front matter, how it is diagnosed, and the effects of its own.
pub const KINDS: &[(&str, Diagnose, Table)] = &[
    ("load-cycle", load_cycle::diagnosed, of_all),
    ("joint-motion", joint_motion::diagnosed, |k| {
        of(k, findings::joint_motion::EFFECTS)
    }),
    ("workspace", workspace::diagnosed, of_all),
    ("hammer", hammer::diagnosed, of_all),
    ("cubes", cubes::diagnosed, |k| {
        of(k, findings::cubes::EFFECTS)
    }),
    ("force-sensor", force_sensor::diagnosed, |k| {
        of(k, findings::force_sensor::EFFECTS)
    }),
    ("screw", screw::diagnosed, |k| {
        of(k, findings::screw::EFFECTS)
    }),
    ("milling-force", milling_force::diagnosed, |k| {
        of(k, findings::milling_force::EFFECTS)
    }),
    ("milled-part", milled_part::diagnosed, |k| {
        of(k, findings::milled_part::EFFECTS)
    }),
];

/// The kind of a file, and how it is diagnosed. A universal file is a hammer test; a CSV file that states none is read as a load cycle,
/// whose reader says what is missing.
///
/// # Errors
/// The file cannot be read, or is of a kind that nothing diagnoses.
pub fn kind(path: &Path) -> Outcome<(&'static str, Diagnose)> {
    kind_said(path).map_err(|problem| problem.in_file(path))
}

fn kind_said(path: &Path) -> Outcome<(&'static str, Diagnose)> {
    if is_universal(path) {
        return Ok(("hammer", hammer::diagnosed));
    }
    let front = front_of(path)?;
    let said = front.text("kind")?.unwrap_or(KINDS[0].0);
    let found = KINDS.iter().find(|kind| kind.0 == said).copied();
    found.map(|kind| (kind.0, kind.1)).ok_or_else(|| {
        let known: Vec<&str> = KINDS.iter().map(|kind| kind.0).collect();
        let what = format!("nothing diagnoses the kind `{said}`");
        let remedy = format!("give a file of kind {}", known.join(", "));
        front.problem("kind", what, remedy)
    })
}

/// The names of all kinds.
pub fn kinds() -> Vec<&'static str> {
    KINDS.iter().map(|kind| kind.0).collect()
}
