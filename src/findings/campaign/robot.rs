//! The robot that a campaign ends with, and what its experiments predict for each other.

use super::{Check, DiagnosedFile};
use crate::findings::joint::Joint;
use crate::findings::kinds::Diagnosed;
use crate::fit::axis_tests::{self, AxisTest};
use crate::fit::identified_robot::with_axis_tests;
use crate::robot::Robot;
use rayon::prelude::*;

/// A robot with the stiffness that the axis tests found, their gaps left closed: weight presses each
/// joint to one side, and whether it does is what a test of the whole robot says.
pub fn stiffened(robot: &Robot, tests: &[AxisTest]) -> Robot {
    let mut informed = with_axis_tests(robot, &axis_tests::named_as(tests.to_vec(), robot));
    let before: Vec<(String, Vec<f64>)> = robot
        .springs()
        .map(|(site, spring)| (site, spring.backlash.clone()))
        .collect();
    for (site, spring) in informed.springs_mut() {
        let own = before.iter().find(|(name, _)| *name == site);
        spring.backlash = own.map_or(Vec::new(), |(_, gaps)| gaps.clone());
    }
    informed
}

/// Every pair of tests of the whole robot of which one changed the robot.
pub fn checks(files: &[DiagnosedFile]) -> Vec<Check> {
    let pairs: Vec<(&DiagnosedFile, &DiagnosedFile)> = files
        .iter()
        .flat_map(|from| files.iter().map(move |against| (from, against)))
        .filter(|(from, against)| from.path() != against.path())
        .collect();
    let check = |(from, against): (&DiagnosedFile, &DiagnosedFile)| {
        let robot = from
            .found
            .extended()
            .filter(|r| Some(*r) != from.found.robot())?;
        let after = against.found.under(robot)?;
        let (a, b) = (from.found.answer(), against.found.answer());
        Some(Check::new(
            (&from.name(), a),
            (&against.name(), b),
            after.answer(),
        ))
    };
    pairs.into_par_iter().filter_map(check).collect()
}

/// The robot that all tests together extend: the first with what it fits for the causes that all of them
/// believe in, each other one starting from what those before it found.
pub fn extended(files: &[DiagnosedFile], joint: Option<&Joint>) -> Option<Robot> {
    let mut robot: Option<Robot> = None;
    let mut changed = false;
    for one in files {
        let again = robot.as_ref().and_then(|robot| one.found.under(robot));
        let found: &dyn Diagnosed = again.as_deref().unwrap_or(one.found.as_ref());
        let believed = joint.filter(|_| again.is_none());
        let believed = believed.and_then(|joint| noted(one, joint));
        let after = believed.or_else(|| found.extended().cloned());
        if let (Some(before), Some(after)) = (found.robot(), after) {
            changed |= *before != after;
            robot = Some(after);
        }
    }
    robot.filter(|_| changed)
}

/// The robot of one experiment with what of the joint belief it shows, and a note of where that comes from.
fn noted(one: &DiagnosedFile, joint: &Joint) -> Option<Robot> {
    let belief = one.found.belief()?;
    let own = belief.visible(&joint.best);
    let mut robot = belief.robot(&joint.best)?.clone();
    let said: Vec<String> = own
        .iter()
        .map(|(e, site)| format!("{e} at {site}"))
        .collect();
    if !said.is_empty() {
        let (tests, name) = (joint.tests.join(", "), one.name());
        let said = said.join(", ");
        robot.notes.push(format!(
            "`ident diagnose`: {said}; named by {tests} together, amounts fitted to {name}"
        ));
    }
    Some(robot)
}
