//! Every file of a campaign diagnosed, and each held against the others.

use super::{Campaign, remarks};
use crate::cli::diagnose::One;
use crate::cli::diagnose::kind::{Diagnosed, KINDS, kind};
use crate::cli::diagnose::next::Proposal;
use crate::cli::output::tell;
use crate::cli::progress::Progress;
use crate::findings::campaign::{Check, verdict};
use crate::findings::joint::Joint;
use crate::fit::axis_tests::{self, AxisTest};
use crate::fit::identified_robot::with_axis_tests;
use crate::ground::problem::{Outcome, Problem};
use crate::measurement::leading::fact_of;
use crate::measurement::workspace::Place;
use crate::robot::Robot;
use rayon::prelude::*;
use std::path::{Path, PathBuf};

/// Role of a file that is measured only to be compared with another.
const COMPARISON: &str = "comparison";

/// Diagnoses every file of a campaign that can be diagnosed.
///
/// # Errors
/// A file that cannot be read, or none at all.
pub fn examine(place: &Place, progress: bool) -> Outcome<Campaign> {
    let mut paths: Vec<PathBuf> = Vec::new();
    for (name, _) in KINDS {
        for path in place.files_of(name)? {
            let role = fact_of(&path, "role").map_err(|problem| problem.in_file(&path))?;
            paths.extend(role.is_none_or(|role| role != COMPARISON).then_some(path));
        }
    }
    if paths.is_empty() {
        let remedy = "put measurements there whose front matter says `kind`";
        return Err(
            Problem::new("holds no measurement that can be diagnosed", remedy)
                .in_file(&place.measurements()),
        );
    }
    let found = axis_tests::read(&place.fits(), &place.measurements())?;
    found
        .remarks
        .iter()
        .for_each(|remark| tell(&format!("warning: {remark}")));
    let tests = found.tests;
    let progress = Progress::new(paths.len(), progress);
    let files = paths.par_iter().map(|path| {
        let one = one(path, place, &tests);
        progress.done(&path.display().to_string());
        one
    });
    let files: Vec<Outcome<One>> = files.collect();
    progress.finish();
    let files = files.into_iter().collect::<Outcome<Vec<One>>>()?;
    let checks = checks(&files);
    let (next, refused) = match Proposal::of_campaign(place, &files) {
        Ok(next) => (next, None),
        Err(problem) => (None, Some(format!("No set-ups are planned: {problem}"))),
    };
    let closed = remarks::closed_gaps(&files, &tests);
    let believed = files.iter();
    let believed = believed.filter_map(|one| Some((one.stem(), one.found.belief()?)));
    let joint = Joint::of(&believed.collect::<Vec<_>>());
    Ok(Campaign {
        next,
        remarks: closed.into_iter().chain(refused).collect(),
        verdict: verdict(
            files.iter().map(|one| one.found.answer()),
            &checks,
            joint.as_ref(),
        ),
        robot: extended(&files, joint.as_ref()),
        joint,
        place: place.clone(),
        checks,
        files,
    })
}

/// One file; a test of the whole robot is simulated with what the axis tests found.
///
/// # Errors
/// A file that cannot be read, or that nothing diagnoses.
pub fn one(path: &Path, place: &Place, tests: &[AxisTest]) -> Outcome<One> {
    let (kind, diagnose) = kind(path)?;
    let found = diagnose(path)?;
    let informed = found.robot().filter(|_| !tests.is_empty());
    let informed = informed.and_then(|robot| found.under(&stiffened(robot, tests)));
    Ok(One {
        kind,
        place: place.clone(),
        found: informed.unwrap_or(found),
    })
}

/// A robot with the stiffness that the axis tests found, their gaps left closed: weight presses each
/// joint to one side, and whether it does is what a test of the whole robot says.
fn stiffened(robot: &Robot, tests: &[AxisTest]) -> Robot {
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
fn checks(files: &[One]) -> Vec<Check> {
    let pairs: Vec<(&One, &One)> = files
        .iter()
        .flat_map(|from| files.iter().map(move |against| (from, against)))
        .filter(|(from, against)| from.path() != against.path())
        .collect();
    let check = |(from, against): (&One, &One)| {
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
fn extended(files: &[One], joint: Option<&Joint>) -> Option<Robot> {
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
fn noted(one: &One, joint: &Joint) -> Option<Robot> {
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
