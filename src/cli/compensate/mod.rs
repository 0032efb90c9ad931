//! `ident compensate`: the programmed path moved so that the soft robot cuts the part that was drawn;
//! what will be left, and the proof that the corrected path stays within its limits.

mod account;
mod json;
mod page;
mod path;

use super::output::{print, print_result, tell};
use super::planned::Planned;
use super::{Ending, Verb, arguments, parsed};
use crate::compensation::method::{METHODS, Search, with};
use crate::compensation::proof::{Checked, proof};
use crate::compensation::remaining::{Size, Station, interval, remaining};
use crate::compensation::{Correction, Method, search};
use crate::ground::files;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::V3;
use crate::measurement::workspace::job_results;
use crate::process::setup::{Setup, Support};
use crate::process::uncertainty::{self, Doubt};
use crate::process::way::normal_part;
use crate::report::{html, svg};
use crate::sheet::page::file;
use clap::{ArgMatches, Args};
use std::path::{Path, PathBuf};

/// The verb.
pub const VERB: Verb = Verb {
    name: "compensate",
    about: "Correct a job's path so that the soft robot cuts the part that was drawn",
    arguments: arguments::<Arguments>,
    run,
};

#[derive(Args)]
struct Arguments {
    /// The job file (kind = "job") with robot, path, tool, material and stock
    job: PathBuf,
    /// Print one JSON document instead of the account
    #[arg(long)]
    json: bool,
    /// How the correction is found: mirror, ideal-force
    #[arg(long, default_value = METHODS[0].name)]
    method: String,
    /// Judge the corrected path on the robot and the material of another job
    #[arg(long, value_name = "JOB")]
    plant: Option<PathBuf>,
    /// Judge with springs only instead of robot and cut coupled in time
    #[arg(long = "static")]
    springs: bool,
    /// Write no path and no report
    #[arg(long)]
    dry_run: bool,
}

/// Whether the part will be within its tolerance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Met {
    Yes,
    No,
    NotCertain,
}

impl Met {
    fn word(self) -> &'static str {
        match self {
            Self::Yes => "yes",
            Self::No => "no",
            Self::NotCertain => "not-certain",
        }
    }

    /// From what is left (m), its interval and the tolerance.
    fn of(max: f64, ci95: Option<[f64; 2]>, tolerance: Option<f64>) -> Self {
        match (ci95, tolerance) {
            (_, Some(tolerance)) if max > tolerance => Self::No,
            (Some([_, high]), Some(tolerance)) if high <= tolerance => Self::Yes,
            _ => Self::NotCertain,
        }
    }
}

/// A compensated job.
struct Result {
    planned: Planned,
    plant: Option<Planned>,
    method: &'static Method,
    found: Search,
    before: Size,
    after: Size,
    stations: [Vec<Station>; 2],
    ci95: Option<[f64; 2]>,
    doubts: Vec<Doubt>,
    met: Met,
    checked: Vec<Checked>,
}

/// What was written.
#[derive(Default)]
struct Written {
    path: Option<PathBuf>,
    report: Option<PathBuf>,
}

fn run(matches: &ArgMatches) -> Outcome<Ending> {
    let arguments: Arguments = parsed(matches);
    let result = act(&arguments)?;
    let written = match arguments.dry_run {
        true => Written::default(),
        false => write(&result)?,
    };
    let inputs = result.inputs();
    match arguments.json {
        true => print_result("compensate", &inputs, json::body(&result, &written))?,
        false => print(&account::text(&result, &written))?,
    }
    for remark in account::remarks(&result) {
        tell(&format!("{}: {remark}", result.planned.job.path.display()));
    }
    Ok(
        match result.met == Met::Yes && result.checked.iter().all(|c| c.ok) {
            true => Ending::Done,
            false => Ending::Attention,
        },
    )
}

fn method(name: &str) -> Outcome<&'static Method> {
    METHODS
        .iter()
        .find(|method| method.name == name)
        .ok_or_else(|| {
            let names: Vec<&str> = METHODS.iter().map(|method| method.name).collect();
            Problem::new(
                format!("`--method {name}` is not known"),
                format!("choose one of: {}", names.join(", ")),
            )
        })
}

fn act(arguments: &Arguments) -> Outcome<Result> {
    let method = method(&arguments.method)?;
    let planned = Planned::read(&arguments.job)?;
    let setup = planned.setup(None)?;
    let in_job = |problem: Problem| problem.in_file(&planned.job.path);
    let found = search(method, &setup, &planned.plan).map_err(in_job)?;
    let plant = arguments.plant.as_deref().map(Planned::read).transpose()?;
    let truth = match &plant {
        Some(plant) => of_plant(&setup, plant)?,
        None => setup.clone(),
    };
    let support = if arguments.springs {
        Support::Static
    } else {
        Support::Coupled
    };
    let none = Correction::none(planned.plan.path.length);
    let corrected = with(&truth, &planned.plan, &found.correction).map_err(in_job)?;
    let (first, _) = truth.run(support, |_| {}).map_err(in_job)?;
    let (second, _) = corrected.run(support, |_| {}).map_err(in_job)?;
    let before = remaining(&first, &none, &setup.way);
    let after = remaining(&second, &found.correction, &setup.way);
    let doubts = uncertainty::doubts(&setup.robot, &setup, &planned.coefficient_stds());
    let model = with(&setup, &planned.plan, &found.correction).map_err(in_job)?;
    let ci95 = likely(&model, &setup, &doubts, &after)?;
    let size = Size::of(&after);
    let checked = proof(&planned.plan, &corrected.way, &found.correction, &second);
    Ok(Result {
        met: Met::of(size.max_m, ci95, planned.job.limits.tolerance),
        before: Size::of(&before),
        after: size,
        stations: [before, after],
        planned,
        plant,
        method,
        found,
        ci95,
        doubts,
        checked,
    })
}

/// The job's motion, stock and tool with the robot and the material of the plant.
fn of_plant(setup: &Setup, plant: &Planned) -> Outcome<Setup> {
    let other = plant.setup(None)?;
    Ok(Setup {
        robot: other.robot,
        material: other.material,
        ..setup.clone()
    })
}

/// Most stations of an interval.
const STATIONS: usize = 1500;

/// 95 % interval of the largest deviation that is left.
fn likely(
    model: &Setup,
    drawn: &Setup,
    doubts: &[Doubt],
    after: &[Station],
) -> Outcome<Option<[f64; 2]>> {
    if doubts.is_empty() {
        return Ok(None);
    }
    let cutting: Vec<&Station> = after.iter().filter(|s| s.cutting).collect();
    let every = cutting.len().div_ceil(STATIONS).max(1);
    let worst = Size::of(after).at_m;
    let chosen: Vec<&Station> = cutting
        .iter()
        .enumerate()
        .filter(|(i, s)| i % every == 0 || s.s_m == worst)
        .map(|(_, s)| *s)
        .collect();
    let times: Vec<f64> = chosen.iter().map(|s| s.time_s).collect();
    let mut changes = uncertainty::changes(model, doubts, &times)?;
    for list in &mut changes {
        for (change, time) in list.iter_mut().zip(&times) {
            *change = normal_part(*change, drawn.way.feed(*time));
        }
    }
    let left: Vec<V3> = chosen.iter().map(|s| s.left).collect();
    Ok(interval(&left, &changes))
}

impl Result {
    /// Path and hash of every file, the job first.
    fn inputs(&self) -> Vec<(String, String)> {
        let plant = self.plant.iter().flat_map(|plant| plant.inputs.clone());
        let mut all = self.planned.inputs.clone();
        for input in plant {
            if !all.contains(&input) {
                all.push(input);
            }
        }
        all
    }

    /// By how much the largest deviation fell, percent.
    fn reduction_percent(&self) -> Option<f64> {
        (self.before.max_m > 0.0).then(|| 100.0 * (1.0 - self.after.max_m / self.before.max_m))
    }
}

/// Writes everything, or nothing.
fn write(result: &Result) -> Outcome<Written> {
    let folder = job_results(&result.planned.job.path);
    let corrected = folder.join("compensated.csv");
    let report = folder.join("compensate.html");
    let page = page::page(result);
    let mut contents = vec![(corrected.clone(), path::text(result))];
    for (stem, chart) in page.figures() {
        contents.push((folder.join(file(&stem, chart)), svg::ink(chart)?));
    }
    contents.push((report.clone(), html::ink(&page)?));
    let contents: Vec<(&Path, &[u8])> = contents
        .iter()
        .map(|(path, text)| (path.as_path(), text.as_bytes()))
        .collect();
    files::replace_all(&contents)?;
    Ok(Written {
        path: Some(corrected),
        report: Some(report),
    })
}
