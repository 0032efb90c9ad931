//! What the axis tests and the measuring cubes of a campaign found: the fits that `ident stiffness` left on
//! disk.

mod levers;
mod pooling;

use super::cubes::store::StoredCubes;
use super::parameter::{Identified, Status};
use super::store::{SCHEMA, StoredFit};
use crate::ground::files;
use crate::ground::problem::Outcome;
use crate::measurement::workspace::Place;
use crate::robot::Robot;
use crate::robot::joint_effect::JointEffect;
use levers::{levers, widened};
use pooling::{contradiction, pooled};
use std::path::{Path, PathBuf};

/// One axis test with its stiffness; or one site that measuring cubes fixed, elastic axes of links included.
#[derive(Debug, Clone, PartialEq)]
pub struct AxisTest {
    /// Drive or bearing, as `A6` or `A6-tilt`.
    pub site: String,
    /// The fit on disk.
    pub path: PathBuf,
    /// SHA-256 of the fit.
    pub sha256: String,
    /// The measurement that was fitted, and its SHA-256.
    pub input: (String, String),
    /// Stiffness, N·m/rad, with its standard error: of the fit and of the levers.
    pub stiffness: (f64, f64),
    /// 95 % interval of the stiffness, N·m/rad, for the same reasons.
    pub ci95: [f64; 2],
    /// Backlash, rad, if the test fixed it.
    pub backlash: Option<(f64, [f64; 2])>,
    /// What the test found that a joint carries through time: hysteresis, friction.
    pub effects: Vec<JointEffect>,
}

impl AxisTest {
    /// `axis6.csv 9335545e6d21`: the measurement and the start of its hash.
    pub fn provenance(&self) -> String {
        let short: String = self.input.1.chars().take(12).collect();
        format!("{} {short}", self.input.0)
    }
}

/// The axis tests of a campaign, and what to say of those that are not used as they stand.
#[derive(Debug, Clone, Default)]
pub struct Found {
    /// One per site, in the order of the file names.
    pub tests: Vec<AxisTest>,
    /// One sentence each.
    pub remarks: Vec<String>,
}

/// The axis tests in a folder of fits, and the sites that measuring cubes fixed. Several of one site are
/// pooled, with the scatter between them; a fit whose measurement is gone or changed is not used.
/// `measurements` holds the files that were fitted.
///
/// # Errors
/// A fit that cannot be read.
pub fn read(folder: &Path, measurements: &Path) -> Outcome<Found> {
    gathered(folder, measurements, |path| {
        Ok(match one(path, measurements)? {
            Some(test) => vec![test],
            None => of_cubes(path)?,
        })
    })
}

/// The axis tests alone, as [`read`].
///
/// # Errors
/// A fit that cannot be read.
pub fn without_cubes(folder: &Path, measurements: &Path) -> Outcome<Found> {
    gathered(folder, measurements, |path| {
        Ok(one(path, measurements)?.into_iter().collect())
    })
}

fn gathered(
    folder: &Path,
    measurements: &Path,
    tests: impl Fn(&Path) -> Outcome<Vec<AxisTest>>,
) -> Outcome<Found> {
    let mut found = Found::default();
    let mut sites: Vec<Vec<AxisTest>> = Vec::new();
    for path in fits(folder) {
        let tests = tests(&path)?;
        // all of one file rest on the same measurements
        if let Some(why) = tests.first().and_then(|t| outdated(t, measurements)) {
            found
                .remarks
                .push(format!("{} is not used: {why}", path.display()));
            continue;
        }
        for test in tests {
            match sites.iter_mut().find(|own| own[0].site == test.site) {
                Some(own) => take(own, test),
                None => sites.push(vec![test]),
            }
        }
    }
    for own in sites {
        found.remarks.extend(contradiction(&own));
        found.tests.extend(pooled(&own));
    }
    Ok(found)
}

/// The axis tests of a campaign by the names of this robot's joints; a remark for each that is not used as
/// it stands.
///
/// # Errors
/// A fit that cannot be read.
pub fn of_robot(place: &Place, robot: &Robot) -> Outcome<Found> {
    let mut found = read(&place.fits(), &place.measurements())?;
    found.tests = named_as(found.tests, robot);
    for test in &found.tests {
        let drive = test.site.trim_end_matches("-tilt");
        let elastic = robot.elastic.iter().any(|axis| axis.name == test.site);
        if !elastic && robot.joints.iter().all(|joint| joint.name != drive) {
            found.remarks.push(format!(
                "the test of {} is not used: the robot `{}` has no such joint",
                test.site, robot.name
            ));
        }
    }
    Ok(found)
}

/// Why a fit no longer belongs to its measurements.
fn outdated(test: &AxisTest, measurements: &Path) -> Option<String> {
    if !measurements.is_dir() {
        return None;
    }
    let (names, hashes) = (test.input.0.split(TOGETHER), test.input.1.split(TOGETHER));
    let why = |(name, told): (&str, &str)| changed(&measurements.join(name), told);
    names.zip(hashes).find_map(why)
}

/// Between the names of several measurements of one fit, and between their hashes.
const TOGETHER: &str = " + ";

fn changed(path: &Path, told: &str) -> Option<String> {
    match files::open(path).and_then(|_| hash(path)) {
        Ok(hash) if hash == told => None,
        Ok(_) => Some(format!(
            "{} was changed since it was fitted",
            path.display()
        )),
        Err(_) => Some(format!("its measurement {} is gone", path.display())),
    }
}

fn hash(path: &Path) -> Outcome<String> {
    Ok(files::sha256(&files::read_bytes(path)?))
}

/// Of several fits of one measurement the one named like it counts, then the one with the smallest interval.
fn take(own: &mut Vec<AxisTest>, test: AxisTest) {
    match own.iter_mut().find(|other| other.input == test.input) {
        Some(other) if better(&test, other) => *other = test,
        Some(_) => {}
        None => own.push(test),
    }
}

/// The same tests under the names that a robot gives its joints: tests count joints from 1, and a
/// robot may call its first joint as it likes.
#[must_use]
pub fn named_as(tests: Vec<AxisTest>, robot: &Robot) -> Vec<AxisTest> {
    let renamed = |mut test: AxisTest| {
        test.site = site_in(robot, &test.site);
        test
    };
    tests.into_iter().map(renamed).collect()
}

/// The robot's name for `A3` or `A3-tilt`: the same if it has it, else by position.
fn site_in(robot: &Robot, site: &str) -> String {
    let (drive, tilt) = match site.strip_suffix("-tilt") {
        Some(drive) => (drive, true),
        None => (site, false),
    };
    let known = robot.joints.iter().any(|joint| joint.name == drive);
    let number = drive
        .strip_prefix('A')
        .and_then(|n| n.parse::<usize>().ok());
    let joint = number.and_then(|n| robot.joints.get(n.checked_sub(1)?));
    match joint {
        Some(joint) if !known && tilt => joint.tilt_site(),
        Some(joint) if !known => joint.name.clone(),
        _ => site.to_string(),
    }
}

fn fits(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let paths = entries.map(|entry| entry.path());
    let mut paths: Vec<PathBuf> = paths
        .filter(|path| path.extension().is_some_and(|e| e == "toml"))
        .collect();
    paths.sort();
    paths
}

fn better(a: &AxisTest, b: &AxisTest) -> bool {
    let own_name = |test: &AxisTest| test.path.file_stem() == Path::new(&test.input.0).file_stem();
    let width = |test: &AxisTest| test.stiffness.1 / test.stiffness.0;
    match (own_name(a), own_name(b)) {
        (true, false) => true,
        (false, true) => false,
        _ => width(a) < width(b),
    }
}

/// The axis test in a file; `None` for a file of another kind, or without a stiffness.
fn one(path: &Path, measurements: &Path) -> Outcome<Option<AxisTest>> {
    let bytes = files::read_bytes(path)?;
    let text = String::from_utf8_lossy(&bytes);
    let table = text.parse::<toml::Table>().unwrap_or_default();
    if table.get("schema").and_then(toml::Value::as_str) != Some(SCHEMA) {
        return Ok(None);
    }
    let fit = StoredFit::read(path)?;
    let Some(fitted) = fixed(&fit.parameters, "stiffness") else {
        return Ok(None);
    };
    let known = fit
        .parameters
        .iter()
        .any(|p| p.name == "stiffness" && p.parts.is_some());
    let (value, stderr, ci95) = match known {
        true => fitted,
        false => widened(fitted, levers(&measurements.join(&fit.input))),
    };
    let backlash = fixed(&fit.parameters, "backlash").or_else(|| fixed(&fit.parameters, "gap"));
    Ok((value > 0.0 && stderr > 0.0).then(|| AxisTest {
        site: fit.site.clone(),
        path: path.to_path_buf(),
        sha256: files::sha256(&bytes),
        input: (fit.input.clone(), fit.input_sha256.clone()),
        stiffness: (value, stderr),
        ci95,
        backlash: backlash.map(|(value, _, ci95)| (value, ci95)),
        effects: carried(&fit),
    }))
}

/// Every site that measuring cubes fixed, if the file holds such a fit.
fn of_cubes(path: &Path) -> Outcome<Vec<AxisTest>> {
    let bytes = files::read_bytes(path)?;
    let Some(stored) = StoredCubes::of(&String::from_utf8_lossy(&bytes)) else {
        return Ok(Vec::new());
    };
    let joined = |list: Vec<&str>| list.join(TOGETHER);
    let input = (
        joined(stored.inputs.iter().map(|i| i.file.as_str()).collect()),
        joined(stored.inputs.iter().map(|i| i.sha256.as_str()).collect()),
    );
    let test = |p: &Identified| {
        let known = p.status == Status::Identified && p.stderr? > 0.0;
        Some(AxisTest {
            site: p.site.clone(),
            path: path.to_path_buf(),
            sha256: files::sha256(&bytes),
            input: input.clone(),
            stiffness: (p.value.filter(|_| known)?, p.stderr?),
            ci95: p.ci95?,
            backlash: None,
            effects: Vec::new(),
        })
    };
    Ok(stored.parameters.iter().filter_map(test).collect())
}

/// The effects of a fit that a joint can carry. Their loop is what the test fixed, even where it leaves
/// open which of their parameters shapes it.
fn carried(fit: &StoredFit) -> Vec<JointEffect> {
    let own = fit.model.iter();
    let own = own.filter_map(|e| JointEffect::new(&e.effect, e.p.clone()).ok());
    own.collect()
}

/// Value, standard error and 95 % interval.
type Fixed = (f64, f64, [f64; 2]);

fn fixed(parameters: &[Identified], name: &str) -> Option<Fixed> {
    let found = parameters.iter().find(|p| p.name == name)?;
    Some((found.value?, found.stderr?, found.ci95?))
}
