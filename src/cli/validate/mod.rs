//! `ident validate`: the simulation beside a workspace test, and what the points say of the model.

mod answer;
mod figures;
mod page;
mod tables;

use super::chapter::Chapter;
use super::output::{located, print, tell, warn};
use super::{Ending, Verb, arguments, from_words, parsed};
use crate::experiments::workspace::fits;
use crate::fit::axis_tests::{self, AxisTest};
use crate::fit::identified_robot::{text, with_axis_tests, with_points};
use crate::fit::validation::{Validation, needs_attention, validate};
use crate::ground::files;
use crate::ground::problem::Outcome;
use crate::measurement::workspace::{Place, campaign, only_of_kind};
use crate::measurement::workspace_test::WorkspaceTest;
use crate::report::{folder, text as terminal};
use crate::robot::Robot;
use crate::robot::load::{Loaded, load};
use clap::{ArgMatches, Args};
use std::path::{Path, PathBuf};

/// The verb.
pub const VERB: Verb = Verb {
    name: "validate",
    about: "Compare the simulation with force steps at points of the workspace, and re-identify",
    arguments: arguments::<Arguments>,
    run,
};

#[derive(Args)]
struct Arguments {
    /// Measurement of kind workspace; without it the only one of the campaign
    file: Option<PathBuf>,
    /// Campaign under measurements/, if there are several
    #[arg(long, value_name = "NAME", conflicts_with = "file")]
    campaign: Option<String>,
    /// Robot to simulate as it is; without it the file's robot with what the axis tests found
    #[arg(long, value_name = "ROBOT")]
    robot: Option<String>,
    /// Print one JSON document instead of the account
    #[arg(long)]
    json: bool,
    /// Write no robot and no report
    #[arg(long)]
    dry_run: bool,
}

/// Everything that is reported.
struct Validated {
    test: WorkspaceTest,
    place: Place,
    base: Loaded,
    robot: Robot,
    tests: Vec<AxisTest>,
    found: Validation,
}

fn run(matches: &ArgMatches) -> Outcome<Ending> {
    let arguments: Arguments = parsed(matches);
    let path = measurement(&arguments)?;
    let validated = examine(&arguments, &path)?;
    let page = page::page(&validated);
    let written = match arguments.dry_run {
        true => Vec::new(),
        false => write(&validated, &page)?,
    };
    match arguments.json {
        true => print(&answer::json(&validated, arguments.dry_run))?,
        false => print(&account(&validated, &written))?,
    }
    let warn = |warning: &String| tell(&format!("warning: {}: {warning}", path.display()));
    validated.found.warnings.iter().for_each(warn);
    Ok(ending(&validated))
}

fn measurement(arguments: &Arguments) -> Outcome<PathBuf> {
    match &arguments.file {
        Some(file) => located(file),
        None => only_of_kind(
            &campaign(Path::new(""), arguments.campaign.as_deref())?,
            "workspace",
        ),
    }
}

/// Validates the robot of a campaign at its points, and writes what that found.
///
/// # Errors
/// A file that cannot be read, a robot that does not fit, results that cannot be written.
pub fn chapter(place: &Place) -> Outcome<Option<Chapter>> {
    let files = place.files_of("workspace")?;
    let Some(path) = files.first() else {
        return Ok(None);
    };
    let validated = examine(&from_words::<Arguments>(&files[..1]), path)?;
    let page = page::page(&validated);
    write(&validated, &page)?;
    Ok(Some(Chapter {
        title: "The points of the workspace".into(),
        ending: ending(&validated),
        inputs: vec![(path.clone(), validated.test.sha256.clone())],
        page,
    }))
}

fn ending(validated: &Validated) -> Ending {
    Ending::attention_if(needs_attention(&validated.found))
}

/// Writes the identified robot of a campaign after its axis tests changed: with what the points of
/// its workspace say, if it has such a test for this robot.
///
/// # Errors
/// A fit that cannot be read, a file that cannot be written.
pub fn collect(place: &Place, base: &Loaded, synthetic: bool) -> Outcome<()> {
    let folder = place.measurements();
    let points = only_of_kind(&folder, "workspace").and_then(|path| WorkspaceTest::read(&path));
    let tests = known_tests(place, &base.robot)?;
    let robot = with_axis_tests(&base.robot, &tests);
    let usable = points.ok().filter(|test| {
        let same = load(&test.facts.robot, Some(&test.path)).is_ok_and(|l| l.sha256 == base.sha256);
        same && fits(&robot, test).is_ok()
    });
    let found = match usable {
        Some(test) => {
            let found = validate(&test, &robot, &tests)?;
            with_points(&robot, &found.parameters(), &provenance(&test))
        }
        None => robot,
    };
    let path = place.fits().join("robot.toml");
    files::replace(&path, text(&found, &base.path, synthetic).as_bytes())
}

/// What the axis tests of a campaign found, by the names of this robot's joints; what is not used as it
/// stands is told.
///
/// # Errors
/// A fit that cannot be read.
pub fn known_tests(place: &Place, robot: &Robot) -> Outcome<Vec<AxisTest>> {
    let found = axis_tests::of_robot(place, robot)?;
    warn(&found.remarks);
    Ok(found.tests)
}

/// The measurement and the start of its hash.
fn provenance(test: &WorkspaceTest) -> String {
    let name = files::name(&test.path);
    let short: String = test.sha256.chars().take(12).collect();
    format!("{name} {short}")
}

fn examine(arguments: &Arguments, path: &Path) -> Outcome<Validated> {
    let test = WorkspaceTest::read(path)?;
    let place = Place::of(path);
    let base = match &arguments.robot {
        Some(name) => load(name, None)?,
        None => load(&test.facts.robot, Some(path)).map_err(|p| p.in_file(path))?,
    };
    fits(&base.robot, &test)?;
    let tests = known_tests(&place, &base.robot)?;
    let mut robot = base.robot.clone();
    if arguments.robot.is_none() && !tests.is_empty() {
        robot = with_axis_tests(&robot, &tests);
        tell(&format!(
            "robot: {} with what {} axis tests found ({}); what these points said before is left out, so that they judge freely",
            base.path,
            tests.len(),
            place.fits().display()
        ));
    }
    let found = validate(&test, &robot, &tests)?;
    Ok(Validated {
        test,
        place,
        base,
        robot,
        tests,
        found,
    })
}

impl Validated {
    fn robot_path(&self) -> PathBuf {
        self.place.fits().join("robot.toml")
    }

    /// The robot with everything found.
    fn identified(&self) -> Robot {
        let known = with_axis_tests(&self.base.robot, &self.tests);
        with_points(&known, &self.found.parameters(), &provenance(&self.test))
    }
}

fn write(validated: &Validated, page: &crate::sheet::page::Page) -> Outcome<Vec<PathBuf>> {
    let robot = text(
        &validated.identified(),
        &validated.base.path,
        validated.test.facts.synthetic,
    );
    let path = validated.robot_path();
    let files = vec![(path.clone(), robot)];
    let report = folder::write_with(files, &validated.place.reports(), "validate.html", page)?;
    Ok(vec![path, report])
}

fn account(validated: &Validated, written: &[PathBuf]) -> String {
    let mut said = tables::sentences(validated)
        .iter()
        .map(|(_, s)| format!("{s}\n"))
        .collect::<String>();
    for table in tables::all(validated) {
        said.push('\n');
        said.push_str(&terminal::table(&table));
    }
    let ends = |end: &str| {
        written
            .iter()
            .find(|path| path.to_string_lossy().ends_with(end))
    };
    if let (Some(robot), Some(report)) = (ends("robot.toml"), ends(".html")) {
        said.push_str(&format!(
            "\nidentified robot {}, report {}\n",
            robot.display(),
            report.display()
        ));
    }
    said
}
