//! `ident plan`: from a job to joint angles over time, and what of it the robot cannot do.

mod account;
mod figures;
mod json;
mod page;

use super::output::{print, print_result, tell};
use super::{Ending, Verb, arguments, parsed};
use crate::ground::files;
use crate::ground::problem::Outcome;
use crate::measurement::job::Job;
use crate::measurement::toolpath::Toolpath;
use crate::measurement::workspace::job_results;
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

fn run(matches: &ArgMatches) -> Outcome<Ending> {
    let arguments: Arguments = parsed(matches);
    let planned = planned(&arguments)?;
    let written = match arguments.dry_run {
        true => Written::default(),
        false => write(&planned)?,
    };
    match arguments.json {
        true => print_result("plan", &planned.inputs, json::body(&planned, &written))?,
        false => print(&account::text(&planned, &written))?,
    }
    for remark in account::remarks(&planned) {
        tell(&format!("{}: {remark}", planned.toolpath.path.display()));
    }
    Ok(match planned.plan.exceeded.is_empty() {
        true => Ending::Done,
        false => Ending::Attention,
    })
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

/// Writes everything, or nothing.
fn write(planned: &Planned) -> Outcome<Written> {
    let folder = job_results(&planned.job.path);
    let trajectory = folder.join("trajectory.csv");
    let report = folder.join("index.html");
    let mut contents = vec![(
        trajectory.clone(),
        trajectory::text(&planned.plan, &planned.inputs),
    )];
    contents.extend(inked(&folder, &page::page(planned))?);
    let contents: Vec<(&Path, &[u8])> = contents
        .iter()
        .map(|(path, text)| (path.as_path(), text.as_bytes()))
        .collect();
    files::replace_all(&contents)?;
    Ok(Written {
        trajectory: Some(trajectory),
        program: None,
        report: Some(report),
    })
}

/// Figures and page, the page last.
fn inked(folder: &Path, page: &Page) -> Outcome<Vec<(PathBuf, String)>> {
    let figures = page.figures().into_iter();
    let figures = figures.map(|(stem, chart)| Ok((folder.join(file(&stem, chart)), svg::ink(chart)?)));
    let mut all = figures.collect::<Outcome<Vec<_>>>()?;
    all.push((folder.join("index.html"), html::ink(page)?));
    Ok(all)
}
