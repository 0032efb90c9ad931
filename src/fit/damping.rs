//! From hammer tests and a robot to its dampings: hits judged, FRFs, one tuning over all poses.

use super::damping_priors::{solved, widened_first};
use super::damping_statement::{reported, supported};
use super::frf_data::Measured;
use super::frf_match::{FrfMatch, frf_match};
use super::frf_measured::measured;
use super::frf_model::Pose;
use super::frf_nuisance::Pull;
use super::frf_robot::{Released, parameters, pose, with_values};
use super::frf_tuning::{Parameter, Residuals, Tuned, Tuning};
use super::frf_uncertain::uncertain;
use super::parameter::Identified;
use crate::experiments::hammer_frf::{HammerFrf, Settings, estimate};
use crate::experiments::hammer_given::undecayed;
use crate::experiments::hammer_modes::modes;
use crate::ground::problem::{Outcome, Problem};
use crate::measurement::hammer::HammerRecord;
use crate::measurement::hammer_known;
use crate::motion::uncertain::Known;
use crate::robot::{Robot, check};
use crate::signal::modes::Mode;
use rayon::prelude::*;
use rustfft::num_complex::Complex64;
use std::path::{Path, PathBuf};

/// One hammer test on its way.
#[derive(Debug, Clone)]
pub struct Test {
    /// The file.
    pub path: PathBuf,
    /// What it holds.
    pub record: HammerRecord,
    /// Its FRFs.
    pub frf: HammerFrf,
    /// The modes it shows.
    pub modes: Vec<Mode>,
}

/// What is asked for.
#[derive(Debug, Clone, PartialEq)]
pub struct Request {
    /// How hits become FRFs; `band_hz` is the upper end of the band that is tuned.
    pub settings: Settings,
    /// Lower end of that band, Hz: below it an accelerometer sees drift.
    pub from_hz: f64,
    /// Which constants are tuned.
    pub released: Released,
    /// Terms for what the model leaves out.
    pub residuals: Residuals,
    /// Number of starts.
    pub starts: usize,
}

/// One direction pair at one pose: output, then input, as in `xy`.
#[derive(Debug, Clone)]
pub struct Pair {
    /// Its name.
    pub name: String,
    /// Measured, with variance.
    pub measured: Measured,
    /// Simulated with the robot as it was, at the same `s`.
    pub before: Vec<Complex64>,
    /// Simulated with the tuned robot.
    pub after: Vec<Complex64>,
    /// How well either meets the measured one.
    pub matches: [FrfMatch; 2],
    /// How well the tuned dampings meet it with the robot's own stiffnesses and bodies.
    pub unmoved: FrfMatch,
}

/// What came out.
#[derive(Debug, Clone)]
pub struct Account {
    /// The tuned constants with bounds and priors, without those that are only fitted along.
    pub constants: Vec<Parameter>,
    /// The tuning itself.
    pub tuned: Tuned,
    /// The constants as reported.
    pub parameters: Vec<Identified>,
    /// Where the stiffnesses went that are fitted along, against what is stated of them.
    pub pulls: Vec<Pull>,
    /// Whether the model is right enough for its constants to be told.
    pub supported: bool,
    /// Pairs per test.
    pub pairs: Vec<Vec<Pair>>,
    /// The robot with all values of the best fit.
    pub robot: Robot,
}

/// Reduced chi-square below which FRFs agree with bodies as the robot file has them: right ones gave 0.7 to 1.1
/// on robots of others (`cargo test --test suite damping_robots:: -- --include-ignored --nocapture`).
const AGREED: f64 = 1.25;
/// The same on some of the lines, beyond which the rest of the search is not worth its time.
const HOPELESS: f64 = 1.2 * AGREED;
/// Names of the rows of the Jacobian.
pub const AXES: [&str; 3] = ["x", "y", "z"];

/// Judges the hits of a record, estimates its FRFs, looks for its modes.
///
/// # Errors
/// No usable hit.
pub fn test(path: &Path, record: HammerRecord, settings: &Settings) -> Outcome<Test> {
    let mut frf = estimate(&record, settings).map_err(|problem| problem.in_text(path))?;
    let modes = modes(&frf, settings.band_hz);
    let lasting = undecayed(&frf, &modes);
    frf.remarks.extend(lasting);
    Ok(Test {
        path: path.to_path_buf(),
        modes,
        record,
        frf,
    })
}

/// Tunes the robot to all tests at once.
///
/// # Errors
/// A robot without bodies or springs, a test without pose or without a pair along the base axes.
pub fn identify(tests: &[Test], robot: &Robot, request: &Request) -> Outcome<Account> {
    check::dynamics(robot)?;
    let known = known(tests);
    if known != hammer_known::Known::default() {
        return attempt(tests, robot, request, (known, !known.is_exact()));
    }
    let plain = task(tests, robot, request, (known, false))?;
    let (wide, begun) = widened_first(&plain)?;
    let nothing = begun.worse_than_nothing();
    if nothing || begun.reduced_chi_square() < HOPELESS {
        let exact = account(robot, &plain, solved(&plain, wide, begun)?);
        let agreed = exact.supported && exact.tuned.reduced_chi_square < AGREED;
        if agreed || exact.tuned.worse_than_nothing {
            return Ok(exact);
        }
    }
    attempt(tests, robot, request, (known, true))
}

/// One tuning, with bodies and instruments as exact as the robot file or as uncertain as they are `known`.
/// Where nothing is stated of them they count as exact while the FRFs agree with that.
fn attempt(
    tests: &[Test],
    robot: &Robot,
    request: &Request,
    how: (hammer_known::Known, bool),
) -> Outcome<Account> {
    let task = task(tests, robot, request, how)?;
    let (wide, begun) = widened_first(&task)?;
    Ok(account(robot, &task, solved(&task, wide, begun)?))
}

/// What is to be tuned.
fn task(
    tests: &[Test],
    robot: &Robot,
    request: &Request,
    (known, along): (hammer_known::Known, bool),
) -> Outcome<Tuning> {
    let released = Released {
        prior_ln_std: request.released.prior_ln_std.or(known.damping_rel_std),
        ..request.released
    };
    let constants = parameters(robot, released, stated_spread(tests));
    let known = along.then(|| Known::stated(known));
    let poses = tests
        .iter()
        .map(|test| at_pose(test, robot, &constants, request, known.as_ref()))
        .collect::<Outcome<Vec<_>>>()?;
    let plain = Tuning {
        parameters: constants,
        poses,
        residuals: request.residuals,
        starts: request.starts,
    };
    match along {
        true => uncertain(plain),
        false => Ok(plain),
    }
}

/// What a tuning says of the robot.
fn account(robot: &Robot, task: &Tuning, (tuned, pulls): (Tuned, Vec<Pull>)) -> Account {
    let of = |pose: &Pose| pairs(pose, task, &tuned);
    let pairs: Vec<Vec<Pair>> = task.poses.iter().map(of).collect();
    let asked_for = task.parameters.iter().filter(|p| !p.nuisance);
    let constants: Vec<Parameter> = asked_for.cloned().collect();
    let supported = supported(tuned.reduced_chi_square, &pairs);
    Account {
        parameters: reported(&constants, &tuned, supported),
        robot: with_values(robot, &task.parameters, &tuned.values),
        pairs,
        constants,
        tuned,
        pulls,
        supported,
    }
}

/// The relative standard deviation that the tests state of the robot's stiffnesses, the largest.
fn stated_spread(tests: &[Test]) -> Option<f64> {
    let stated = tests.iter().filter_map(|test| test.record.nominal_rel_std);
    stated.max_by(f64::total_cmp)
}

/// How well bodies and instruments are known: the least that a test says.
fn known(tests: &[Test]) -> hammer_known::Known {
    let stated = tests.iter().map(|test| test.record.known);
    stated
        .reduce(hammer_known::Known::or_worse)
        .unwrap_or_default()
}

fn at_pose(
    test: &Test,
    robot: &Robot,
    constants: &[Parameter],
    request: &Request,
    known: Option<&Known>,
) -> Outcome<Pose> {
    let place = |problem: Problem| problem.in_file(&test.path);
    let joints = joints(test, robot).map_err(place)?;
    let pairs = measured(&test.frf, request.from_hz, request.settings.band_hz);
    if pairs.is_empty() || pairs.iter().all(|pair| pair.frf.is_empty()) {
        return Err(place(Problem::new(
            "no FRF along the base axes in the band",
            "name the directions x, y or z, measure ax, ay or az, and record long enough",
        )));
    }
    let pose = pose(robot, joints, constants, known).map_err(place)?;
    Ok(Pose {
        measured: pairs,
        ..pose
    })
}

fn joints<'a>(test: &'a Test, robot: &Robot) -> Outcome<&'a [f64]> {
    let (wanted, remedy) = (
        robot.dof(),
        "write `# joint_angles_deg = [...]`, one angle per joint; for a universal file into STEM.ident.toml, or add --joints-deg",
    );
    match &test.record.joint_angles {
        Some(angles) if angles.len() == wanted => Ok(angles),
        Some(angles) => {
            let what = format!(
                "{} joint angles, the robot has {wanted} joints",
                angles.len()
            );
            Err(Problem::new(what, remedy).in_column("joint_angles_deg"))
        }
        None => Err(Problem::new("the pose is missing", remedy).in_column("joint_angles_deg")),
    }
}

fn pairs(pose: &Pose, task: &Tuning, tuned: &Tuned) -> Vec<Pair> {
    let kinds = task.kinds();
    let starts: Vec<f64> = task.parameters.iter().map(|p| p.start).collect();
    let asked_for = tuned.uncertainty.statements.len();
    let unmoved = [&tuned.values[..asked_for], &starts[asked_for..]].concat();
    let pair = |measured: &Measured| {
        let simulated = |theta: &[f64]| {
            pose.accelerance(&kinds, theta, measured)
                .unwrap_or_default()
        };
        let (before, after) = (simulated(&starts), simulated(&tuned.values));
        Pair {
            name: format!("{}{}", AXES[measured.output], AXES[measured.input]),
            matches: [&before, &after].map(|h| frf_match(&measured.frf, h)),
            unmoved: frf_match(&measured.frf, &simulated(&unmoved)),
            measured: measured.clone(),
            before,
            after,
        }
    };
    pose.measured.par_iter().map(pair).collect()
}
