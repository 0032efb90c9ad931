//! `ident stiffness CUBES`: measuring cubes become every stiffness of the robot at once.

mod json;
mod page;
mod tables;

use crate::cli::Ending;
use crate::cli::chapter::Chapter;
use crate::cli::output::{print, tell};
use crate::cli::validate;
use crate::fit::axis_tests::{AxisTest, named_as, without_cubes};
use crate::fit::cubes::store::{Input, SCHEMA, StoredCubes};
use crate::fit::cubes::{Account, identify};
use crate::fit::identified_robot::{text, with_cubes};
use crate::fit::parameter::Status;
use crate::fit::suitability::{self, Doubt, is_odd};
use crate::ground::files;
use crate::ground::problem::{Outcome, Problem};
use crate::measurement::cubes::CubeTest;
use crate::measurement::leading::kind_of;
use crate::measurement::workspace::{Place, resolve};
use crate::report::{folder, text as terminal};
use crate::robot::Robot;
use crate::robot::load::{Loaded, load};
use std::path::PathBuf;

/// Everything that is reported.
struct Identified {
    tests: Vec<CubeTest>,
    place: Place,
    base: Loaded,
    axis_tests: Vec<AxisTest>,
    account: Account,
    doubts: Vec<Doubt>,
}

/// The files, if they are of kind cubes.
///
/// # Errors
/// Some are and some are not.
pub fn meant(files: &[PathBuf]) -> Outcome<Option<Vec<PathBuf>>> {
    let mut found = Vec::new();
    for name in files {
        let (path, said) = resolve(name)?;
        let cubes = kind_of(&path).is_ok_and(|kind| kind.as_deref() == Some("cubes"));
        if cubes {
            said.iter().for_each(|s| tell(s));
            found.push(path);
        }
    }
    match found.len() {
        0 => Ok(None),
        n if n == files.len() => Ok(Some(found)),
        _ => Err(Problem::new(
            "some of the files are of kind cubes, others are not",
            "give cubes of one robot together, load cycles in a call of their own",
        )),
    }
}

/// Identifies a robot from its cubes.
///
/// # Errors
/// A file that cannot be read or does not fit its robot, results that cannot be written.
pub fn run(files: &[PathBuf], as_json: bool, dry: bool) -> Outcome<Ending> {
    let found = examine(files)?;
    if !dry {
        write(&found)?;
    }
    match as_json {
        true => print(&json::document(&found, dry))?,
        false => print(&said(&found, dry))?,
    }
    for warning in found.warnings() {
        tell(&format!("warning: {warning}"));
    }
    Ok(found.ending())
}

fn examine(files: &[PathBuf]) -> Outcome<Identified> {
    let tests = files
        .iter()
        .map(|path| CubeTest::read(path))
        .collect::<Outcome<Vec<_>>>()?;
    let robots = tests
        .iter()
        .map(|t| load(&t.facts.robot, Some(&t.path)).map_err(|p| p.in_file(&t.path)));
    let robots = robots.collect::<Outcome<Vec<Loaded>>>()?;
    let stranger = (0..tests.len()).find(|i| robots[*i].sha256 != robots[0].sha256);
    if let Some(i) = stranger {
        return Err(Problem::new(
            "was measured on another robot than the first file",
            "give the files of one robot together",
        )
        .in_file(&tests[i].path)
        .in_column("robot"));
    }
    let mut doubts = Vec::new();
    for test in &tests {
        doubts.extend(passed(test, &robots[0].robot)?);
    }
    let account = identify(&tests, &robots[0].robot)?;
    let place = Place::of(&tests[0].path);
    let axis_tests = match place.campaign.is_empty() {
        true => Vec::new(),
        false => without_cubes(&place.fits(), &place.measurements())?.tests,
    };
    let base = robots.into_iter().next().expect("clap requires a file");
    Ok(Identified {
        tests,
        place,
        axis_tests: named_as(axis_tests, &base.robot),
        base,
        account,
        doubts,
    })
}

/// What is odd about a test that can carry a number.
fn passed(test: &CubeTest, robot: &Robot) -> Outcome<Vec<Doubt>> {
    let doubts = suitability::cubes::doubts(test, robot);
    suitability::refuse(&test.path, &doubts)?;
    Ok(doubts)
}

impl Identified {
    fn stem(&self) -> String {
        self.tests[0].stem()
    }

    fn synthetic(&self) -> bool {
        self.tests.iter().any(|test| test.facts.synthetic)
    }

    fn robot_path(&self) -> PathBuf {
        self.place.fits().join("robot.toml")
    }

    fn report(&self) -> String {
        format!("{}-cubes.html", self.stem())
    }

    /// Where the fit goes: later verbs take it up as they take axis tests.
    fn fit_path(&self) -> PathBuf {
        self.place.fits().join(format!("{}.toml", self.stem()))
    }

    fn stored(&self) -> StoredCubes {
        let input = |test: &CubeTest| Input {
            file: files::name(&test.path),
            sha256: test.sha256.clone(),
        };
        StoredCubes {
            schema: SCHEMA.into(),
            version: env!("CARGO_PKG_VERSION").into(),
            synthetic: self.synthetic(),
            robot: self.base.path.clone(),
            inputs: self.tests.iter().map(input).collect(),
            parameters: self.account.parameters.clone(),
        }
    }

    /// The robot with what the cubes found, outside of a campaign.
    fn robot_text(&self) -> String {
        let test = &self.tests[0];
        let name = files::name(&test.path);
        let short: String = test.sha256.chars().take(12).collect();
        let found = &self.account.parameters;
        let robot = with_cubes(&self.base.robot, found, &format!("{name} {short}"));
        text(&robot, &self.base.path, self.synthetic())
    }

    fn ending(&self) -> Ending {
        Ending::attention_if(self.contradiction() || is_odd(&self.doubts))
    }

    /// Whether the cubes contradict the model beyond the stated noise.
    fn contradiction(&self) -> bool {
        self.account.solved.p_value < 0.01
    }

    fn warnings(&self) -> Vec<String> {
        let mut said: Vec<String> = self.doubts.iter().map(Doubt::sentence).collect();
        if self.contradiction() {
            said.push(format!(
                "{}: the cubes miss the model by more than their noise; intervals are widened, `ident diagnose` says why",
                self.tests[0].path.display()
            ));
        }
        let left_out: usize = self.tests.iter().map(|test| test.left_out).sum();
        if left_out > 0 {
            said.push(format!("{left_out} rows were left out for an empty cell"));
        }
        said
    }

    fn identified(&self) -> usize {
        let known = |p: &&crate::fit::parameter::Identified| p.status == Status::Identified;
        self.account.parameters.iter().filter(known).count()
    }
}

fn write(found: &Identified) -> Outcome<()> {
    Place::nameable(&found.tests[0].path)?;
    let single = found.place.campaign.is_empty();
    let mut files = vec![(found.fit_path(), found.stored().text()?)];
    files.extend(single.then(|| (found.robot_path(), found.robot_text())));
    let page = page::page(found);
    folder::write_with(files, &found.place.reports(), &found.report(), &page)?;
    match single {
        true => Ok(()),
        false => validate::collect(&found.place, &found.base, found.synthetic()),
    }
}

/// Identifies the robot of a campaign from all its cubes, and writes what that found.
///
/// # Errors
/// A file that cannot be read, results that cannot be written.
pub fn chapter(place: &Place) -> Outcome<Option<Chapter>> {
    let (mut files, mut parts) = (Vec::new(), Vec::new());
    for file in place.files_of("cubes")? {
        let test = CubeTest::read(&file)?;
        let robot = load(&test.facts.robot, Some(&file)).map_err(|p| p.in_file(&file))?;
        match passed(&test, &robot.robot) {
            Ok(_) => files.push(file),
            Err(why) => parts.push(Chapter::withheld(test.stem(), test.input(), &why)),
        }
    }
    if !files.is_empty() {
        let found = examine(&files)?;
        write(&found)?;
        parts.push(Chapter {
            title: found.stem(),
            ending: found.ending(),
            inputs: found.tests.iter().map(CubeTest::input).collect(),
            page: page::page(&found),
        });
    }
    Ok(Chapter::together("The measuring cubes", parts))
}

fn said(found: &Identified, dry: bool) -> String {
    let mut said = format!("{}\n\n", tables::sentence(found));
    said += &terminal::table(&tables::parameters(found));
    if let Some(together) = tables::together(found) {
        said += &format!("\n{}", terminal::table(&together));
    }
    if !dry {
        let report = found.place.reports().join(found.report());
        said += &format!(
            "\nfit {}, identified robot {}, report {}\n",
            found.fit_path().display(),
            found.robot_path().display(),
            report.display()
        );
    }
    said
}
