//! `ident survey`: modes of a survey of many points, as they swing, and beside the simulated robot.

mod page;
mod tables;

use super::output::{print, print_result, tell};
use super::{Ending, Verb, arguments, parsed};
use crate::experiments::survey::assignment::{Assignment, assign};
use crate::experiments::survey::modes::{SurveyModes, find};
use crate::experiments::survey::simulated::{Beside, beside};
use crate::ground::problem::{Outcome, Problem};
use crate::ground::units::DEGREE;
use crate::measurement::survey::{self, Survey};
use crate::measurement::workspace::Place;
use crate::motion::skeleton::skeleton;
use crate::report::folder::write_as;
use crate::robot::load::{Loaded, load};
use crate::signal::mac;
use clap::{ArgMatches, Args};
use std::path::{Path, PathBuf};

/// The verb.
pub const VERB: Verb = Verb {
    name: "survey",
    about: "Modes of a survey of many points: shapes that move, modal assurance, beside the simulated robot",
    arguments: arguments::<Arguments>,
    run,
};

#[derive(Args)]
struct Arguments {
    /// Universal file with the FRFs of all points (data set 58) and their geometry (15 or 2411, and 82)
    file: PathBuf,
    /// Universal file that holds the geometry, if FILE does not
    #[arg(long, value_name = "FILE")]
    geometry: Option<PathBuf>,
    /// Highest mode
    #[arg(long = "to-Hz", value_name = "HZ", default_value_t = 100.0)]
    to_hz: f64,
    /// Robot to stand beside: built-in name or file [default: the fact `robot`, if there is one]
    #[arg(long)]
    robot: Option<String>,
    /// Its joint angles in degrees, A1 first [default: the fact `joint_angles_deg`]
    #[arg(
        long,
        value_name = "Q1,..,Q6",
        value_delimiter = ',',
        allow_hyphen_values = true
    )]
    joints_deg: Option<Vec<f64>>,
    /// Print one JSON document instead of the account
    #[arg(long)]
    json: bool,
    /// Write no report
    #[arg(long)]
    dry_run: bool,
}

/// What a survey tells.
struct Told {
    survey: Survey,
    found: SurveyModes,
    /// Modal assurance of the survey's modes among themselves.
    auto: Vec<Vec<f64>>,
    robot: Option<RobotBeside>,
}

/// A robot beside the survey.
struct RobotBeside {
    loaded: Loaded,
    assignment: Assignment,
    beside: Beside,
}

fn run(matches: &ArgMatches) -> Outcome<Ending> {
    let arguments: Arguments = parsed(matches);
    let told = arguments.told()?;
    let folder = folder(&arguments.file);
    let stem = arguments
        .file
        .file_stem()
        .unwrap_or_default()
        .to_string_lossy();
    let written = match arguments.dry_run {
        true => None,
        false => write_as(
            &folder,
            &format!("{stem}-survey.html"),
            &page::page(&stem, &told),
        )?
        .pop(),
    };
    told.remarks()
        .iter()
        .for_each(|remark| tell(&format!("note: {remark}")));
    match arguments.json {
        true => print_result(
            "survey",
            &told.inputs(),
            tables::json(&told, written.as_deref()),
        )?,
        false => print(&tables::text(&told, written.as_deref()))?,
    }
    Ok(Ending::done_if(told.found.remarks.is_empty()))
}

/// The reports of the campaign, else `reports/`.
fn folder(file: &Path) -> PathBuf {
    let place = Place::of(file);
    match place.campaign.is_empty() {
        true => PathBuf::from("reports"),
        false => place.reports(),
    }
}

impl Arguments {
    fn told(&self) -> Outcome<Told> {
        if !(self.to_hz > 0.0 && self.to_hz.is_finite()) {
            let problem = Problem::new("is not a positive number", "give a number above 0");
            return Err(problem.in_column("--to-Hz"));
        }
        let survey = survey::read(&self.file, self.geometry.as_deref())?;
        let found = find(&survey, self.to_hz).map_err(|p| p.in_file(&self.file))?;
        let shapes: Vec<_> = found.modes.iter().map(|mode| mode.shape.clone()).collect();
        let mut survey = survey;
        let robot = match self.standing(&mut survey) {
            Some(name) => Some(self.beside(&name, &survey, &found)?),
            None => None,
        };
        Ok(Told {
            auto: mac::matrix(&shapes, &shapes),
            survey,
            found,
            robot,
        })
    }

    /// The robot to stand beside: as asked, else as stated, where its pose and the place of the survey are too.
    fn standing(&self, survey: &mut Survey) -> Option<String> {
        let stated = survey.record.robot.clone();
        let posed = self.joints_deg.is_some() || survey.record.joint_angles.is_some();
        match (&self.robot, stated) {
            (Some(asked), _) => Some(asked.clone()),
            (None, Some(stated)) if posed && survey.placement.origin.is_some() => Some(stated),
            (None, Some(stated)) => {
                survey.remarks.push(format!(
                    "not held beside the simulation of {stated}: joint_angles_deg and survey_origin_mm have to be stated for that"
                ));
                None
            }
            (None, None) => None,
        }
    }

    fn beside(&self, name: &str, survey: &Survey, found: &SurveyModes) -> Outcome<RobotBeside> {
        let loaded = load(name, Some(&self.file))?;
        let joints = self.joints(&loaded, survey)?;
        let line = skeleton(&loaded.robot, &joints);
        let sidecar = crate::measurement::foreign::sidecar::place(&self.file);
        let assignment = assign(survey, &line).map_err(|p| p.in_file(&sidecar))?;
        let beside = beside(survey, &found.modes, &assignment, (&loaded.robot, &joints))?;
        Ok(RobotBeside {
            loaded,
            assignment,
            beside,
        })
    }

    fn joints(&self, loaded: &Loaded, survey: &Survey) -> Outcome<Vec<f64>> {
        let typed = self.joints_deg.as_ref();
        let typed = typed.map(|all| all.iter().map(|q| q * DEGREE).collect::<Vec<f64>>());
        let given = typed.or(survey.record.joint_angles.clone()).ok_or_else(|| {
            Problem::new(
                "at which joint angles the robot stood is not stated",
                "give --joints-deg, or write `joint_angles_deg = [...]` into STEM.ident.toml beside the file",
            )
            .in_file(&self.file)
        })?;
        match given.len() == loaded.robot.dof() && given.iter().all(|q| q.is_finite()) {
            true => Ok(given),
            false => Err(Problem::new(
                format!("{} angles for {} joints", given.len(), loaded.robot.dof()),
                "give one finite angle per joint, in degrees",
            )
            .in_column("--joints-deg")),
        }
    }
}

impl Told {
    fn inputs(&self) -> Vec<(String, String)> {
        let files = self.survey.inputs.iter();
        let files = files.map(|(path, hash)| (path.display().to_string(), hash.clone()));
        let robot = self.robot.iter().map(|robot| robot.loaded.input());
        files.chain(robot).collect()
    }

    /// What a reader should know, in the order of the work.
    fn remarks(&self) -> Vec<String> {
        let robot = self
            .robot
            .iter()
            .flat_map(|robot| robot.assignment.remarks.iter());
        let own = self.survey.remarks.iter().chain(&self.found.remarks);
        own.chain(robot).cloned().collect()
    }

    /// Points with responses.
    fn measured(&self) -> usize {
        let points = self.survey.dofs.iter().map(|dof| dof.0);
        points.collect::<std::collections::BTreeSet<_>>().len()
    }
}
