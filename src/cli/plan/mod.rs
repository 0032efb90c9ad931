//! `ident plan`: from a job to joint angles over time, and what of it the robot cannot do.

mod account;
mod figures;
mod json;
mod page;

use super::chapter::{self, Chapter};
use super::output::{print, print_result, tell};
use super::{Ending, Verb, arguments, parsed};
use crate::ground::problem::Outcome;
use crate::measurement::workspace::{Place, job_results};
use crate::path::programs::{Exporter, ProgramFile};
use crate::planning::trajectory;
use crate::process::Planned;
use crate::report::folder;
use clap::{ArgMatches, Args};
use std::path::PathBuf;

/// The verb.
pub const VERB: Verb = Verb {
    name: "plan",
    about: "Plan a job: path, feed, joint angles; trajectory, pictures and robot program",
    arguments: arguments::<Arguments>,
    run,
};

#[derive(Args)]
struct Arguments {
    /// The job file (kind = "job"), which names robot and path
    job: PathBuf,
    /// Print one JSON document instead of the account
    #[arg(long)]
    json: bool,
    /// Write a robot program too: krl, rapid or gcode
    #[arg(long, value_name = "LANGUAGE")]
    program: Option<String>,
    /// Write no trajectory, no program and no report
    #[arg(long)]
    dry_run: bool,
}

/// What was written.
#[derive(Default)]
struct Written {
    trajectory: Option<PathBuf>,
    program: Option<PathBuf>,
    report: Option<PathBuf>,
}

/// Plans the part of a campaign, `measurements/<campaign>/part/job.toml`, if there is one.
///
/// # Errors
/// A job that cannot be planned, results that cannot be written.
pub fn chapter(place: &Place) -> Outcome<Option<Chapter>> {
    let Some(planned) = chapter::planned_part(place)? else {
        return Ok(None);
    };
    write(&planned, Vec::new())?;
    let input = |(path, hash): &(String, String)| (PathBuf::from(path), hash.clone());
    Ok(Some(Chapter {
        title: "The part".into(),
        ending: ending(&planned),
        inputs: planned.inputs[..2].iter().map(input).collect(),
        page: page::page(&planned),
    }))
}

fn ending(planned: &Planned) -> Ending {
    Ending::done_if(planned.plan.exceeded.is_empty())
}

fn run(matches: &ArgMatches) -> Outcome<Ending> {
    let arguments: Arguments = parsed(matches);
    let exporter = arguments.program.as_deref().map(Exporter::named);
    let exporter = exporter.transpose()?;
    let planned = planned(&arguments)?;
    let programs = exporter.map(|e| planned.programs(e, &planned.inputs));
    let programs = programs.transpose()?;
    let written = match arguments.dry_run {
        true => Written::default(),
        false => write(&planned, programs.unwrap_or_default())?,
    };
    match arguments.json {
        true => print_result("plan", &planned.inputs, json::body(&planned, &written))?,
        false => print(&account::text(&planned, &written))?,
    }
    for remark in account::remarks(&planned) {
        tell(&format!("{}: {remark}", planned.toolpath.path.display()));
    }
    Ok(ending(&planned))
}

/// Reads and plans. Where the robot does not reach, the JSON document says so before the refusal.
fn planned(arguments: &Arguments) -> Outcome<Planned> {
    match Planned::try_read(&arguments.job)? {
        Ok(planned) => Ok(planned),
        Err(unplanned) => {
            if arguments.json {
                let body = json::unreached(&unplanned.unreached);
                print_result("plan", &unplanned.inputs, body)?;
            }
            Err(unplanned.problem)
        }
    }
}

/// Writes everything, or nothing.
fn write(planned: &Planned, programs: Vec<ProgramFile>) -> Outcome<Written> {
    let place = job_results(&planned.job.path);
    let trajectory = place.join("trajectory.csv");
    let text = trajectory::text(&planned.plan, &planned.inputs);
    let mut files = vec![(trajectory.clone(), text)];
    let main = programs.first().map(|program| place.join(&program.name));
    let programs = programs.into_iter();
    files.extend(programs.map(|program| (place.join(&program.name), program.text)));
    let report = folder::write_with(files, &place, "index.html", &page::page(planned))?;
    Ok(Written {
        trajectory: Some(trajectory),
        program: main,
        report: Some(report),
    })
}
