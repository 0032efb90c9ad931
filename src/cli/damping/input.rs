//! Which hammer tests and which robot are meant.

use super::Arguments;
use crate::cli::output::tell;
use crate::experiments::hammer_frf::Settings;
use crate::fit::damping::{Test, test};
use crate::fit::suitability::Doubt;
use crate::fit::suitability::hammer::{doubts, refuse};
use crate::ground::files;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::units::DEGREE;
use crate::measurement::hammer::HammerRecord;
use crate::measurement::hammer_uff::read_any;
use crate::measurement::workspace::{Place, resolve};
use crate::robot::load::{Loaded, load};
use rayon::prelude::*;
use std::path::{Path, PathBuf};

/// Tests, robot, and where results go.
pub struct Input {
    /// The tests, hits judged.
    pub tests: Vec<Test>,
    /// The robot as it is simulated now.
    pub robot: Loaded,
    /// Where they belong.
    pub place: Place,
    /// Comparison tests that were not taken.
    pub passed_over: Vec<PathBuf>,
    /// What is odd about the tests.
    pub doubts: Vec<Doubt>,
}

impl Input {
    /// Names of the files.
    pub fn names(&self) -> String {
        let names = self.tests.iter().map(|t| files::name(&t.path));
        names.collect::<Vec<_>>().join(", ")
    }
}

/// Reads what the arguments mean.
pub fn read(arguments: &Arguments, settings: &Settings) -> Outcome<Input> {
    let (place, paths) = match arguments.frf.is_empty() {
        true => in_campaign(arguments)?,
        false => named(arguments)?,
    };
    let records = paths
        .into_par_iter()
        .map(|path| Ok((read_any(&path)?, path)))
        .collect::<Vec<Outcome<(HammerRecord, PathBuf)>>>();
    let records = records.into_iter().collect::<Outcome<Vec<_>>>()?;
    let records = posed(arguments, records)?;
    let (taken, left) = chosen(arguments, records);
    let robot = robot(arguments, &place, &taken)?;
    let doubts = taken
        .iter()
        .flat_map(|(record, _)| doubts(record))
        .collect();
    let tests: Vec<Outcome<Test>> = taken
        .into_par_iter()
        .map(|(record, path)| passed(&path, record, settings))
        .collect();
    Ok(Input {
        tests: tests.into_iter().collect::<Outcome<Vec<_>>>()?,
        robot,
        place,
        passed_over: left.into_iter().map(|(_, path)| path).collect(),
        doubts,
    })
}

/// A test that passes the gate: what is odd about it stands among its remarks.
fn passed(path: &Path, record: HammerRecord, settings: &Settings) -> Outcome<Test> {
    let doubts = doubts(&record);
    refuse(&doubts).map_err(|problem| problem.in_text(path))?;
    let mut test = test(path, record, settings)?;
    let odd = doubts.iter().map(Doubt::sentence);
    test.frf.remarks.extend(odd);
    Ok(test)
}

type Records = Vec<(HammerRecord, PathBuf)>;

/// `--joints-deg` is the pose of the files that state none.
fn posed(arguments: &Arguments, mut records: Records) -> Outcome<Records> {
    let Some(degrees) = &arguments.joints_deg else {
        return Ok(records);
    };
    if degrees.iter().any(|q| !q.is_finite()) {
        let problem = Problem::new("a joint angle is not finite", "give degrees as numbers");
        return Err(problem.in_column("--joints-deg"));
    }
    let mut open = records
        .iter_mut()
        .filter(|(record, _)| record.joint_angles.is_none());
    let Some((first, _)) = open.next() else {
        let problem = Problem::new(
            "every file states its pose already",
            "leave --joints-deg out, or correct `joint_angles_deg` in the file",
        );
        return Err(problem.in_column("--joints-deg"));
    };
    let angles: Vec<f64> = degrees.iter().map(|q| q * DEGREE).collect();
    open.for_each(|(record, _)| record.joint_angles = Some(angles.clone()));
    first.joint_angles = Some(angles);
    Ok(records)
}

/// Comparison tests are taken only when they are named, or when there is nothing else.
fn chosen(arguments: &Arguments, records: Records) -> (Records, Records) {
    let all = records.iter().all(|(record, _)| record.comparison);
    let take = !arguments.frf.is_empty() || all;
    records
        .into_iter()
        .partition(|(record, _)| take || !record.comparison)
}

fn in_campaign(arguments: &Arguments) -> Outcome<(Place, Vec<PathBuf>)> {
    let place = Place::campaign(arguments.campaign.as_deref())?;
    let paths = place.files_of("hammer")?;
    if paths.is_empty() {
        return Err(Problem::new(
            "no hammer test in this campaign",
            "add a CSV file with `# kind = \"hammer\"`, or name a file after --frf",
        )
        .in_file(&place.measurements()));
    }
    Ok((place, paths))
}

fn named(arguments: &Arguments) -> Outcome<(Place, Vec<PathBuf>)> {
    let mut paths: Vec<PathBuf> = Vec::new();
    for name in &arguments.frf {
        let (path, said) = resolve(name)?;
        said.iter().for_each(|said| tell(said));
        if !paths.contains(&path) {
            paths.push(path);
        }
    }
    let place = Place::of(paths.first().map_or(Path::new(""), |path| path.as_path()));
    if let Some(other) = paths.iter().find(|path| Place::of(path) != place) {
        return Err(Problem::new(
            "belongs to another campaign than the first file",
            "put the tests of one robot into one folder under measurements/",
        )
        .in_file(other));
    }
    Ok((place, paths))
}

/// `--robot`, else the identified robot of the campaign, else what the files name.
fn robot(arguments: &Arguments, place: &Place, records: &Records) -> Outcome<Loaded> {
    if let Some(name) = &arguments.robot {
        return load(name, None);
    }
    let identified = place.fits().join("robot.toml");
    if !place.campaign.is_empty() && identified.exists() {
        return load(&identified.display().to_string(), None);
    }
    let named = records
        .iter()
        .map(|(record, path)| (record.robot.as_deref(), path));
    let mut robots = named.collect::<Vec<_>>().into_iter();
    let (Some((Some(name), path)), all) = (robots.next(), robots) else {
        let problem = Problem::new(
            "names no robot",
            "write `# robot = \"kr210\"`, or add --robot",
        );
        let file = records
            .first()
            .map_or(Path::new(""), |(_, path)| path.as_path());
        return Err(problem.in_column("robot").in_file(file));
    };
    for (other, file) in all {
        if other != Some(name) {
            return Err(Problem::new(
                format!("is not the robot `{name}` of the first file"),
                "tune the tests of one robot at a time, or say which with --robot",
            )
            .in_column("robot")
            .in_file(file));
        }
    }
    load(name, Some(path))
}
