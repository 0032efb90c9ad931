//! `ident stiffness CUBES`: measuring cubes become every stiffness of the robot at once.

mod json;
mod page;
mod tables;

use crate::cli::Ending;
use crate::cli::output::{print, tell};
use crate::fit::axis_tests::{self, AxisTest};
use crate::fit::cubes::{Account, identify};
use crate::fit::identified_robot::{text, with_axis_tests, with_cubes};
use crate::fit::parameter::Status;
use crate::ground::files;
use crate::ground::problem::{Outcome, Problem};
use crate::measurement::cubes::CubeTest;
use crate::measurement::leading::kind_of;
use crate::measurement::workspace::{Place, resolve};
use crate::report::{folder, text as terminal};
use crate::robot::load::{Loaded, load};
use std::path::PathBuf;

/// Everything that is reported.
struct Identified {
    tests: Vec<CubeTest>,
    place: Place,
    base: Loaded,
    axis_tests: Vec<AxisTest>,
    account: Account,
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
    Ok(match found.contradiction() {
        true => Ending::Attention,
        false => Ending::Done,
    })
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
    let account = identify(&tests, &robots[0].robot)?;
    let place = Place::of(&tests[0].path);
    let axis_tests = match place.campaign.is_empty() {
        true => Vec::new(),
        false => axis_tests::read(&place.fits(), &place.measurements())?.tests,
    };
    let base = robots.into_iter().next().expect("clap requires a file");
    Ok(Identified {
        tests,
        place,
        base,
        axis_tests,
        account,
    })
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

    /// The robot with everything found: the axis tests of the campaign first, where it has any.
    fn robot_text(&self) -> String {
        let test = &self.tests[0];
        let name = test.path.file_name().unwrap_or_default().to_string_lossy();
        let short: String = test.sha256.chars().take(12).collect();
        let known = with_axis_tests(&self.base.robot, &self.axis_tests);
        let robot = with_cubes(&known, &self.account.parameters, &format!("{name} {short}"));
        text(&robot, &self.base.path, self.synthetic())
    }

    /// Whether the cubes contradict the model beyond the stated noise.
    fn contradiction(&self) -> bool {
        self.account.solved.p_value < 0.01
    }

    fn warnings(&self) -> Vec<String> {
        let mut said = Vec::new();
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
    folder::write_as(&found.place.reports(), &found.report(), &page::page(found))?;
    files::replace(&found.robot_path(), found.robot_text().as_bytes())
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
            "\nidentified robot {}, report {}\n",
            found.robot_path().display(),
            report.display()
        );
    }
    said
}
