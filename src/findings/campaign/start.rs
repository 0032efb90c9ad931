//! What a plan starts from: the robot of a campaign, its axis tests, its points.

use crate::experiments::workspace::fits;
use crate::fit::axis_tests::{AxisTest, of_robot};
use crate::ground::problem::{Outcome, Problem};
use crate::measurement::leading::{front_of, kind_of};
use crate::measurement::rig::Rig;
use crate::measurement::workspace::{Place, only_of_kind};
use crate::measurement::workspace_test::WorkspaceTest;
use crate::robot::check;
use crate::robot::load::{Loaded, load};
use std::path::Path;

/// The kind of measurement that a plan continues.
const KIND: &str = "workspace";
/// Other kinds that name the robot of a campaign.
const NAMING: [&str; 3] = ["hammer", "load-cycle", "joint-motion"];

/// What a plan starts from.
pub struct Start {
    /// Where it belongs.
    pub place: Place,
    /// The robot as it is simulated now.
    pub base: Loaded,
    /// What the axis tests found.
    pub tests: Vec<AxisTest>,
    /// The points that were measured already.
    pub points: Option<WorkspaceTest>,
    /// What can be built.
    pub rig: Rig,
    /// Whether the measurements were simulated.
    pub synthetic: bool,
    /// Which axis tests are not used as they stand, one sentence each.
    pub warnings: Vec<String>,
}

impl Start {
    /// From a campaign; `None` if no measurement there names its robot.
    ///
    /// # Errors
    /// Several workspace tests to choose from, or a robot that cannot be simulated.
    pub fn campaign(place: Place) -> Outcome<Option<Self>> {
        match place.files_of(KIND)?.is_empty() {
            true => of_name(place),
            false => {
                let path = only_of_kind(&place.measurements(), KIND)?;
                Self::points(place, &path).map(Some)
            }
        }
    }

    /// Continues a workspace test.
    ///
    /// # Errors
    /// A file that is no workspace test, or a robot that cannot be simulated.
    pub fn points(place: Place, path: &Path) -> Outcome<Self> {
        let kind = kind_of(path).map_err(|problem| problem.in_file(path))?;
        if kind.as_deref().is_some_and(|kind| kind != KIND) {
            let remedy = "give a file of kind workspace, or the folder of the campaign";
            let said =
                "--next plans set-ups on the whole robot, which this file says nothing about";
            return Err(Problem::new(said, remedy).in_file(path));
        }
        let test = WorkspaceTest::read(path)?;
        let base = load(&test.facts.robot, Some(path)).map_err(|p| p.in_file(path))?;
        fits(&base.robot, &test)?;
        let found = of_robot(&place, &base.robot)?;
        Ok(Self {
            tests: found.tests,
            warnings: found.remarks,
            rig: Rig::of_folder(path.parent().unwrap_or(Path::new("")))?,
            synthetic: test.facts.synthetic,
            points: Some(test),
            place,
            base,
        })
    }

    /// Files that the plan rests on, with their hashes.
    pub fn inputs(&self) -> Vec<(String, String)> {
        let points = self.points.iter();
        let points = points.map(|t| (t.path.display().to_string(), t.sha256.clone()));
        let tests = self.tests.iter();
        let tests = tests.map(|t| (t.path.display().to_string(), t.sha256.clone()));
        points.chain([self.base.input()]).chain(tests).collect()
    }
}

/// Begins with the robot that other measurements of the campaign name.
fn of_name(place: Place) -> Outcome<Option<Start>> {
    for kind in NAMING {
        for path in place.files_of(kind)? {
            let Ok(front) = front_of(&path) else {
                continue;
            };
            if let Some(name) = front.text("robot").map_err(|p| p.in_file(&path))? {
                let base = load(name, Some(&path)).map_err(|p| p.in_file(&path))?;
                elastic(&base)?;
                let found = of_robot(&place, &base.robot)?;
                return Ok(Some(Start {
                    rig: Rig::of_folder(&place.measurements())?,
                    tests: found.tests,
                    warnings: found.remarks,
                    synthetic: front.synthetic(),
                    points: None,
                    place,
                    base,
                }));
            }
        }
    }
    Ok(None)
}

fn elastic(base: &Loaded) -> Outcome<()> {
    match base.robot.is_elastic() {
        true => check::bodies(&base.robot),
        false => {
            let what = format!("nothing in the robot `{}` is elastic", base.robot.name);
            let remedy = "add `drive = { stiffness_Nm_rad = .. }` to its joints";
            Err(Problem::new(what, remedy))
        }
    }
}
