//! `ident compensate`: the programmed path moved so that the soft robot cuts the part that was drawn;
//! what will be left, and the proof that the corrected path stays within its limits.

mod account;
mod json;
mod page;

use super::output::{print, print_result, tell};
use super::{Ending, Verb, arguments, parsed};
use crate::compensation::calm::calm;
use crate::compensation::executed::executed;
use crate::compensation::limits::{Certainty, certainty};
use crate::compensation::method::{METHODS, Search};
use crate::compensation::online::Sensor;
use crate::compensation::proof::{Checked, proof};
use crate::compensation::remaining::{Size, Station, remaining};
use crate::compensation::shifted::shifted;
use crate::compensation::text::text;
use crate::compensation::{Correction, Method, Task, search};
use crate::fit::force_sensor::store::StoredSensor;
use crate::ground::problem::{Outcome, Problem};
use crate::measurement::workspace::job_results;
use crate::path::programs::{EXPORTERS, Exporter, ProgramFile};
use crate::process::Planned;
use crate::process::setup::{Setup, Support};
use crate::process::uncertainty::{self, Doubt};
use crate::report::folder;
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
    /// How the correction is found: mirror, ideal-force, hybrid, online
    #[arg(long, default_value = METHODS[0].name)]
    method: String,
    /// Judge the corrected path on the robot and the material of another job
    #[arg(long, value_name = "JOB")]
    plant: Option<PathBuf>,
    /// Language of the robot program: krl, rapid or gcode
    #[arg(long, value_name = "LANGUAGE", default_value = EXPORTERS[0].name)]
    program: String,
    /// Model of the force sensor, written by `ident sensor` (online and hybrid)
    #[arg(long, value_name = "FILE")]
    sensor: Option<PathBuf>,
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

    /// From what is left (m), what it will not exceed (m) and the tolerance.
    fn of(max: f64, at_most: Option<f64>, tolerance: Option<f64>) -> Self {
        match (at_most, tolerance) {
            (_, Some(tolerance)) if max > tolerance => Self::No,
            (Some(at_most), Some(tolerance)) if at_most <= tolerance => Self::Yes,
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
    /// The corrected path as a file, and the programs that run it.
    text: String,
    programs: Vec<ProgramFile>,
    before: Size,
    after: Size,
    stations: [Vec<Station>; 2],
    /// Rapid motions are slowed to the feed.
    slowed: bool,
    /// What the method that it improves on leaves, by its name.
    beside: Option<(&'static str, Vec<Station>)>,
    certainty: Certainty,
    doubts: Vec<Doubt>,
    met: Met,
    checked: Vec<Checked>,
}

/// What was written.
#[derive(Default)]
struct Written {
    path: Option<PathBuf>,
    program: Option<PathBuf>,
    report: Option<PathBuf>,
}

fn run(matches: &ArgMatches) -> Outcome<Ending> {
    let arguments: Arguments = parsed(matches);
    let result = act(&arguments)?;
    let written = match arguments.dry_run {
        true => Written::default(),
        false => write(&result)?,
    };
    let inputs = inputs(&result.planned, result.plant.as_ref());
    match arguments.json {
        true => print_result("compensate", &inputs, json::body(&result, &written))?,
        false => print(&account::text(&result, &written))?,
    }
    for remark in account::remarks(&result) {
        tell(&format!("{}: {remark}", result.planned.job.path.display()));
    }
    Ok(result.ending())
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
    let exporter = Exporter::named(&arguments.program)?;
    let planned = Planned::read(&arguments.job)?;
    let in_job = |problem: Problem| problem.in_file(&planned.job.path);
    let support = arguments.support();
    let calmed = match support {
        Support::Coupled => calm(&planned)?,
        _ => None,
    };
    let base = calmed.as_ref().unwrap_or(&planned);
    let (drawn, setup) = (planned.setup(None)?, base.setup(None)?);
    let plant = arguments.plant.as_deref().map(Planned::read).transpose()?;
    let of_plant = |setup: &Setup| {
        plant
            .as_ref()
            .map_or(Ok(setup.clone()), |p| of_plant(setup, p))
    };
    let truth = of_plant(&setup)?;
    let task = Task {
        setup: &setup,
        truth: &truth,
        plan: &base.plan,
        support,
        sensor: sensor(arguments.sensor.as_deref())?,
    };
    let found = search(method, &task).map_err(in_job)?;
    let inputs = inputs(&planned, plant.as_ref());
    let synthetic = planned.toolpath.synthetic || planned.job.synthetic;
    let text = text(
        &base.plan,
        &found.correction,
        method.name,
        &inputs,
        synthetic,
    );
    let executed = match method.live {
        true => None,
        false => Some(executed(base, &corrected_path(&planned), &text)?),
    };
    let way = match &executed {
        Some(executed) => executed.way.clone(),
        None => shifted(&base.plan, &found.correction).map_err(in_job)?,
    };
    let runner = executed.as_ref().map_or(base, |e| &e.planned);
    let programs = runner.programs(exporter, &inputs)?;
    let none = Correction::none(base.plan.path.length);
    let corrected = |setup: &Setup| Setup {
        way: way.clone(),
        ..setup.clone()
    };
    let (first, _) = of_plant(&drawn)?.run(support, |_| {}).map_err(in_job)?;
    let (second, _) = corrected(&truth).run(support, |_| {}).map_err(in_job)?;
    let before = remaining(&first, &none, &drawn.way);
    let after = remaining(&second, &found.correction, &setup.way);
    let model = corrected(&setup);
    let expected = match &plant {
        None => after.clone(),
        Some(_) => {
            let (milled, _) = model.run(support, |_| {}).map_err(in_job)?;
            remaining(&milled, &found.correction, &setup.way)
        }
    };
    let beside = beside(method, &task).map_err(in_job)?;
    let doubts = uncertainty::doubts(&setup.robot, &setup, &planned.coefficient_stds());
    let certainty = certainty(&model, &setup, support, &doubts, &expected).map_err(in_job)?;
    let size = Size::of(&after);
    let checked = proof(&planned.plan, &way, &found.correction, &second);
    Ok(Result {
        met: Met::of(
            size.max_m,
            certainty.at_most_m,
            planned.job.limits.tolerance,
        ),
        before: Size::of(&before),
        after: size,
        stations: [before, after],
        slowed: calmed.is_some(),
        beside,
        text,
        programs,
        planned,
        plant,
        method,
        found,
        certainty,
        doubts,
        checked,
    })
}

impl Arguments {
    fn support(&self) -> Support {
        match self.springs {
            true => Support::Static,
            false => Support::Coupled,
        }
    }
}

/// What the method that a method improves on leaves.
fn beside(method: &Method, task: &Task) -> Outcome<Option<(&'static str, Vec<Station>)>> {
    let Some(other) = METHODS.iter().find(|m| Some(m.name) == method.beside) else {
        return Ok(None);
    };
    let found = search(other, task)?;
    let corrected = Setup {
        way: shifted(task.plan, &found.correction)?,
        ..task.truth.clone()
    };
    let (milled, _) = corrected.run(task.support, |_| {})?;
    let left = remaining(&milled, &found.correction, &task.setup.way);
    Ok(Some((other.name, left)))
}

/// Where the corrected path goes.
fn corrected_path(planned: &Planned) -> PathBuf {
    job_results(&planned.job.path).join("compensated.csv")
}

/// What the sensor's model leaves of weight, offset and hoses.
fn sensor(path: Option<&Path>) -> Outcome<Sensor> {
    let usual = Sensor::default();
    match path {
        None => Ok(usual),
        Some(path) => Ok(Sensor {
            rest_n: StoredSensor::read(path)?.rest_n(),
            ..usual
        }),
    }
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

/// Path and hash of every file, the job first.
fn inputs(planned: &Planned, plant: Option<&Planned>) -> Vec<(String, String)> {
    let mut all = planned.inputs.clone();
    for input in plant.iter().flat_map(|plant| &plant.inputs) {
        if !all.contains(input) {
            all.push(input.clone());
        }
    }
    all
}

impl Result {
    /// Good, or something needs attention.
    fn ending(&self) -> Ending {
        match self.met == Met::Yes && self.checked.iter().all(|c| c.ok) {
            true => Ending::Done,
            false => Ending::Attention,
        }
    }

    /// By how much the largest deviation fell, percent.
    fn reduction_percent(&self) -> Option<f64> {
        (self.before.max_m > 0.0).then(|| 100.0 * (1.0 - self.after.max_m / self.before.max_m))
    }
}

/// Writes everything, or nothing.
fn write(result: &Result) -> Outcome<Written> {
    let place = job_results(&result.planned.job.path);
    let corrected = corrected_path(&result.planned);
    let mut files = vec![(corrected.clone(), result.text.clone())];
    let programs = result.programs.iter();
    files.extend(programs.map(|p| (place.join(&p.name), p.text.clone())));
    let report = folder::write_with(files, &place, "compensate.html", &page::page(result))?;
    Ok(Written {
        path: Some(corrected),
        program: result.programs.first().map(|p| place.join(&p.name)),
        report: Some(report),
    })
}
