//! A diagnosed workspace test: its figures and its extended robot.

use super::workspace_figures as figures;
use super::{Diagnosed, Source};
use crate::experiments::workspace::fits;
use crate::findings::belief::Belief;
use crate::findings::sentence::spoken;
use crate::findings::workspace::{Limit, WorkspaceDiagnosis, diagnose, judgement};
use crate::findings::{Answer, Verdict};
use crate::fit::force_steps::Setup;
use crate::fit::validation::mean_and_max;
use crate::ground::files;
use crate::ground::problem::Outcome;
use crate::ground::spatial::M3;
use crate::measurement::workspace_test::{DIRECTIONS, WorkspaceTest};
use crate::robot::load::{Loaded, load};
use crate::robot::{Robot, write};
use crate::sheet::chart::Chart;
use crate::sheet::number::significant;
use serde_json::{Map, Value, json};
use std::path::Path;

/// What is said where one force a cycle was read.
const FROM_UNLOADED: &str =
    "One force was read in every cycle: displacements count from the unloaded robot.";

/// A test with its robot and what was found.
pub(super) struct Workspace {
    pub(super) test: WorkspaceTest,
    robot: Loaded,
    pub(super) found: WorkspaceDiagnosis,
}

/// Diagnoses a file of this kind.
///
/// # Errors
/// The file is no workspace test, or its robot cannot be simulated.
pub fn diagnosed(path: &Path) -> Outcome<Box<dyn Diagnosed>> {
    let test = WorkspaceTest::read(path)?;
    let robot = load(&test.facts.robot, Some(path)).map_err(|p| p.in_file(path))?;
    fits(&robot.robot, &test)?;
    let found = diagnose(&test, &robot.robot);
    Ok(Box::new(Workspace { test, robot, found }))
}

impl Diagnosed for Workspace {
    fn answer(&self) -> &Answer {
        &self.found
    }

    fn source(&self) -> Source<'_> {
        Source::new(
            &self.test.path,
            &self.test.sha256,
            self.test.facts.synthetic,
        )
    }

    fn about(&self) -> String {
        format!(
            "{} at {} points",
            self.robot.robot.name,
            self.test.facts.joint_angles.len()
        )
    }

    fn before_and_after(&self) -> Vec<Chart> {
        figures::before_and_after(self)
    }

    fn remaining(&self) -> Vec<Chart> {
        vec![figures::remaining(self)]
    }

    fn robot(&self) -> Option<&Robot> {
        Some(&self.robot.robot)
    }

    fn extended(&self) -> Option<&Robot> {
        Some(&self.found.extended)
    }

    fn under(&self, robot: &Robot) -> Option<Box<dyn Diagnosed>> {
        let found = diagnose(&self.test, robot);
        let robot = Loaded {
            robot: robot.clone(),
            ..self.robot.clone()
        };
        let test = self.test.clone();
        Some(Box::new(Workspace { test, robot, found }))
    }

    fn belief(&self) -> Option<&Belief> {
        let answer = self.answer();
        let known = answer.verdict != Verdict::UnknownCause && !answer.is_withheld();
        known.then_some(&self.found.belief)
    }

    fn model(&self) -> Outcome<Option<String>> {
        let changed = self.found.extended != self.robot.robot;
        Ok(changed.then(|| self.extended()))
    }

    fn unseen(&self) -> Option<String> {
        let limits = self.found.limits.iter();
        let said: Vec<String> = limits.map(unnoticed).collect();
        (!said.is_empty()).then(|| {
            format!(
                "what these points hardly load may be wrong without a sign: {}.",
                said.join(", ")
            )
        })
    }

    fn remarks(&self) -> Vec<String> {
        let counted = self.test.from_unloaded.then(|| FROM_UNLOADED.to_string());
        let said = self.unseen();
        let said = said.map(|said| said.replacen('w', "W", 1));
        counted.into_iter().chain(said).collect()
    }

    fn more(&self) -> Map<String, Value> {
        let mut map = Map::new();
        let limit = |l: &Limit| json!({"effect": l.effect, "site": l.site, "unnoticed_excess_of_compliance": l.known()});
        let limits = self.found.limits.iter().map(limit);
        map.insert("limits".into(), Value::Array(limits.collect()));
        let error = |d: usize| {
            let before = mean_error(self, &self.found.simulated, d)?;
            let after = mean_error(self, &self.found.unseen, d)?;
            Some(
                json!({"direction": DIRECTIONS[d], "before_percent": before, "after_percent": after}),
            )
        };
        let errors = (0..3).filter_map(error).collect();
        map.insert(
            "stiffness_error_at_unseen_points".into(),
            Value::Array(errors),
        );
        let judgement = serde_json::to_value(judgement()).unwrap_or_default();
        map.insert("judgement".into(), judgement);
        map
    }
}

impl Workspace {
    /// The extended robot as a file, with where it comes from.
    fn extended(&self) -> String {
        let mut robot = self.found.extended.clone();
        let name = files::name(&self.test.path);
        let short: String = self.test.sha256.chars().take(12).collect();
        let causes = self.found.causes.iter();
        let causes: Vec<String> = causes
            .map(|c| format!("{} at {}", c.effect, c.site))
            .collect();
        robot.notes.push(format!(
            "Extended by ident {} diagnose from {}, {} {short}: {}.",
            env!("CARGO_PKG_VERSION"),
            self.robot.path,
            name,
            causes.join(", ")
        ));
        write::labelled(&robot, self.test.facts.synthetic)
    }

    /// The set-ups loaded in one direction.
    pub(super) fn along(&self, direction: usize) -> Vec<&Setup> {
        let all = self.found.shapes.setups.iter();
        all.filter(|s| s.direction == direction).collect()
    }
}

/// `drive stiffness at A4 (up to 2.7 times as soft)`.
fn unnoticed(limit: &Limit) -> String {
    let extent = match limit.known() {
        Some(excess) => format!("up to {} times as soft", significant(1.0 + excess, 2)),
        None => "however soft".into(),
    };
    format!("{} at {} ({extent})", spoken(limit.effect), limit.site)
}

/// Mean error of the simulated stiffness along the force, %, by direction.
fn mean_error(result: &Workspace, slopes: &[M3], direction: usize) -> Option<f64> {
    let own = result.along(direction);
    let error = |s: &&Setup| {
        let measured = s.lines[direction]?.slope;
        let simulated = slopes[s.point][direction][direction];
        Some(100.0 * (measured / simulated - 1.0)).filter(|e| e.is_finite())
    };
    mean_and_max(own.iter().filter_map(error)).map(|found| found.0)
}
