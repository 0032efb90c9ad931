//! `ident plan`: from a job to joint angles over time, and what of it the robot cannot do.

mod account;
mod figures;
mod json;
mod page;

use super::chapter::Chapter;
use super::output::{print, print_result, tell};
use super::{Ending, Verb, arguments, from_words, parsed};
use crate::ground::files;
use crate::ground::problem::Outcome;
use crate::measurement::job::Job;
use crate::measurement::toolpath::Toolpath;
use crate::measurement::workspace::{Place, job_results};
use crate::path::programs::{Exporter, ProgramFile};
use crate::planning::program::program;
use crate::planning::{self, Plan, trajectory};
use crate::report::{html, svg};
use crate::robot::load::load;
use crate::sheet::page::{Page, file};
use clap::{ArgMatches, Args};
use std::path::{Path, PathBuf};

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

/// A planned job with what it rests on.
struct Planned {
    job: Job,
    toolpath: Toolpath,
    plan: Plan,
    /// Path and SHA-256 of every file, the job first.
    inputs: Vec<(String, String)>,
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
    let job = place.measurements().join("part").join("job.toml");
    if !job.is_file() {
        return Ok(None);
    }
    let planned = planned(&from_words::<Arguments>(&[job]))?;
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
    match planned.plan.exceeded.is_empty() {
        true => Ending::Done,
        false => Ending::Attention,
    }
}

fn run(matches: &ArgMatches) -> Outcome<Ending> {
    let arguments: Arguments = parsed(matches);
    let exporter = arguments.program.as_deref().map(Exporter::named);
    let exporter = exporter.transpose()?;
    let planned = planned(&arguments)?;
    let programs = exporter.map(|e| programs(e, &planned)).transpose()?;
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
    let job = Job::read(&arguments.job)?;
    let toolpath = Toolpath::read(&job.toolpath)?;
    let robot = load(&job.robot, Some(&job.path))?;
    let mut inputs = vec![
        (job.path.display().to_string(), job.sha256.clone()),
        (toolpath.path.display().to_string(), toolpath.sha256.clone()),
        robot.input(),
    ];
    let further = toolpath.inputs.iter().chain(&job.inputs);
    inputs.extend(further.map(|(path, hash)| (path.display().to_string(), hash.clone())));
    match planning::plan(&job, &toolpath, &robot.robot)? {
        Ok(plan) => Ok(Planned {
            job,
            toolpath,
            plan,
            inputs,
        }),
        Err(unreached) => {
            if arguments.json {
                print_result("plan", &inputs, json::unreached(&unreached))?;
            }
            Err(unreached.problem().in_file(&toolpath.path))
        }
    }
}

/// The plan in the language of a controller, the main file first.
fn programs(exporter: &Exporter, planned: &Planned) -> Outcome<Vec<ProgramFile>> {
    let name = planned.toolpath.path.file_stem().unwrap_or_default();
    let comment = |(path, hash): &(String, String)| format!("{path} sha256 {hash}");
    let comments = planned.inputs.iter().map(comment).collect();
    let stated = planned.toolpath.moves.iter().find_map(|step| step.spindle);
    let cutter = planned
        .job
        .cutter
        .as_ref()
        .and_then(|cutter| cutter.spindle);
    let name = name.to_string_lossy();
    let program = program(&planned.plan, &name, comments, cutter.or(stated));
    exporter
        .write(&program)
        .map_err(|problem| problem.in_file(&planned.job.path))
}

/// Writes everything, or nothing.
fn write(planned: &Planned, programs: Vec<ProgramFile>) -> Outcome<Written> {
    let folder = job_results(&planned.job.path);
    let trajectory = folder.join("trajectory.csv");
    let report = folder.join("index.html");
    let mut contents = vec![(
        trajectory.clone(),
        trajectory::text(&planned.plan, &planned.inputs),
    )];
    let main = programs.first().map(|program| folder.join(&program.name));
    let programs = programs.into_iter();
    contents.extend(programs.map(|program| (folder.join(&program.name), program.text)));
    contents.extend(inked(&folder, &page::page(planned))?);
    let contents: Vec<(&Path, &[u8])> = contents
        .iter()
        .map(|(path, text)| (path.as_path(), text.as_bytes()))
        .collect();
    files::replace_all(&contents)?;
    Ok(Written {
        trajectory: Some(trajectory),
        program: main,
        report: Some(report),
    })
}

/// Figures and page, the page last.
fn inked(folder: &Path, page: &Page) -> Outcome<Vec<(PathBuf, String)>> {
    let figures = page.figures().into_iter();
    let figures =
        figures.map(|(stem, chart)| Ok((folder.join(file(&stem, chart)), svg::ink(chart)?)));
    let mut all = figures.collect::<Outcome<Vec<_>>>()?;
    all.push((folder.join("index.html"), html::ink(page)?));
    Ok(all)
}
