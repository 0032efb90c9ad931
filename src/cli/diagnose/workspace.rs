//! A diagnosed workspace test: its figures and its extended robot.

use super::kind::{Diagnosed, Source};
use crate::findings::workspace::{WorkspaceDiagnosis, diagnose};
use crate::findings::{Answer, Verdict};
use crate::fit::force_steps::Setup;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::M3;
use crate::measurement::workspace_test::{DIRECTIONS, WorkspaceTest};
use crate::robot::load::{Loaded, load};
use crate::robot::{Robot, check, write};
use crate::sheet::chart::{Axis, Chart, Panel, Series};
use serde_json::{Map, Value, json};
use std::path::Path;

struct Workspace {
    test: WorkspaceTest,
    robot: Loaded,
    found: WorkspaceDiagnosis,
}

/// Diagnoses a file of this kind.
///
/// # Errors
/// The file is no workspace test, or its robot cannot be simulated.
pub fn diagnosed(path: &Path) -> Outcome<Box<dyn Diagnosed>> {
    let test = WorkspaceTest::read(path)?;
    let robot = load(&test.facts.robot, Some(path)).map_err(|p| p.in_file(path))?;
    usable(&robot.robot, &test)?;
    let found = diagnose(&test, &robot.robot);
    Ok(Box::new(Workspace { test, robot, found }))
}

/// Refuses a robot that these points cannot be simulated with.
fn usable(robot: &Robot, test: &WorkspaceTest) -> Outcome<()> {
    let angles = test.facts.joint_angles.first().map_or(0, Vec::len);
    let refuse = |what: String, remedy: &str| Err(Problem::new(what, remedy).in_file(&test.path));
    if angles != robot.dof() {
        return refuse(
            format!(
                "gives {angles} joint angles per point, the robot `{}` has {} joints",
                robot.name,
                robot.dof()
            ),
            "correct `joint_angles_deg`, or name the right robot",
        );
    }
    if !robot.is_elastic() {
        return refuse(
            format!("nothing in the robot `{}` is elastic", robot.name),
            "add `drive = { stiffness_Nm_rad = .. }` to its joints; `ident robot convert FILE` makes an editable copy",
        );
    }
    check::bodies(robot).map_err(|problem| problem.in_file(&test.path))
}

impl Diagnosed for Workspace {
    fn answer(&self) -> &Answer {
        &self.found
    }

    fn source(&self) -> Source<'_> {
        Source {
            path: &self.test.path,
            sha256: &self.test.sha256,
            synthetic: self.test.facts.synthetic,
        }
    }

    fn about(&self) -> String {
        format!(
            "{} at {} points",
            self.robot.robot.name,
            self.test.facts.joint_angles.len()
        )
    }

    fn before_and_after(&self) -> Vec<Chart> {
        vec![stiffness(self), errors(self)]
    }

    fn remaining(&self) -> Vec<Chart> {
        vec![remaining(self)]
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

    fn model(&self) -> Outcome<Option<String>> {
        let changed = self.found.extended != self.robot.robot;
        Ok(changed.then(|| self.extended()))
    }

    fn more(&self) -> Map<String, Value> {
        let mut map = Map::new();
        let limit = |l: &crate::findings::workspace::Limit| json!({"effect": l.effect, "site": l.site, "unnoticed_excess_of_compliance": l.unnoticed});
        let limits = self.found.limits.iter().map(limit);
        map.insert("limits".into(), Value::Array(limits.collect()));
        map
    }
}

impl Workspace {
    /// The extended robot as a file, with where it comes from.
    fn extended(&self) -> String {
        let mut robot = self.found.extended.clone();
        let name = self.test.path.file_name().unwrap_or_default();
        let short: String = self.test.sha256.chars().take(12).collect();
        let causes = self.found.causes.iter();
        let causes: Vec<String> = causes
            .map(|c| format!("{} at {}", c.effect, c.site))
            .collect();
        robot.notes.push(format!(
            "Extended by ident {} diagnose from {}, {} {short}: {}.",
            env!("CARGO_PKG_VERSION"),
            self.robot.path,
            name.to_string_lossy(),
            causes.join(", ")
        ));
        let label = match self.test.facts.synthetic {
            true => "# synthetic: extended from simulated measurements\n",
            false => "",
        };
        format!("{label}{}", write::write(&robot))
    }

    fn along(&self, direction: usize) -> Vec<&Setup> {
        let all = self.found.shapes.setups.iter();
        all.filter(|s| s.direction == direction).collect()
    }
}

fn at(slopes: &[M3], setup: &Setup, k: usize) -> f64 {
    slopes[setup.point][setup.direction][k]
}

fn stiffness(result: &Workspace) -> Chart {
    let panel = |d: usize| {
        let own = result.along(d);
        let bars = |slopes: &[M3]| {
            own.iter()
                .map(|s| 1e-3 / at(slopes, s, d))
                .collect::<Vec<_>>()
        };
        let measured = own
            .iter()
            .map(|s| s.lines[d].map_or(f64::NAN, |l| 1e-3 / l.slope));
        let y = Axis::new(format!("Stiffness in {}", DIRECTIONS[d]), "N/mm");
        Panel::new(Axis::new("Point", ""), y)
            .over(own.iter().map(|s| format!("P{}", s.point + 1)))
            .with(Series::bars("measured", &measured.collect::<Vec<_>>()))
            .with(Series::bars("simulated", &bars(&result.found.simulated)))
            .with(Series::bars(
                "with the causes",
                &bars(&result.found.explained),
            ))
    };
    let chart = Chart::new(
        format!("{}-diagnosis", result.test.stem()),
        "Stiffness at the points: measured, simulated, and with the causes in the model",
        "Force over displacement along the same direction.",
    );
    let panels = (0..3).filter(|d| !result.along(*d).is_empty()).map(panel);
    panels
        .fold(chart, Chart::with)
        .synthetic(result.test.facts.synthetic)
}

fn errors(result: &Workspace) -> Chart {
    let panel = |k: usize| {
        let own: Vec<&Setup> = result
            .found
            .shapes
            .setups
            .iter()
            .filter(|s| s.lines[k].is_some())
            .collect();
        let bars = |slopes: &[M3]| {
            let error = |s: &&Setup| s.lines[k].map_or(0.0, |l| 1e9 * (l.slope - at(slopes, s, k)));
            own.iter().map(error).collect::<Vec<f64>>()
        };
        let y = Axis::new(format!("Error in {}", DIRECTIONS[k]), "µm/kN");
        Panel::new(Axis::new("Point and direction of the force", ""), y)
            .over(
                own.iter()
                    .map(|s| format!("{}{}", s.point + 1, DIRECTIONS[s.direction])),
            )
            .with(Series::bars(
                "present simulation",
                &bars(&result.found.simulated),
            ))
            .with(Series::bars(
                "with the causes",
                &bars(&result.found.explained),
            ))
    };
    let chart = Chart::new(
        format!("{}-errors", result.test.stem()),
        "Measured less simulated displacement, by component",
        "Every component of the displacement under force in every direction.",
    );
    (0..3)
        .map(panel)
        .filter(|p| !p.categories.is_empty())
        .fold(chart, Chart::with)
        .synthetic(result.test.facts.synthetic)
}

fn remaining(result: &Workspace) -> Chart {
    let mut rest = errors(result);
    rest.name = format!("{}-remaining", result.test.stem());
    rest.title = "What no named cause explains".into();
    for panel in &mut rest.panels {
        panel.series.remove(0);
    }
    let _ = Verdict::Sufficient;
    rest
}
