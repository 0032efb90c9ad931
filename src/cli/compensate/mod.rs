//! `ident compensate`: the programmed path moved so that the soft robot cuts the part that was drawn;
//! what will be left, and the proof that the corrected path stays within its limits.

mod account;
mod json;
mod page;

use super::chapter::{self, Chapter};
use super::output::{print, print_result, tell};
use super::{Ending, Verb, arguments, parsed};
use crate::compensation::Method;
use crate::compensation::corrected::{Corrected, Request, correct, corrected_path, inputs};
use crate::compensation::method::METHODS;
use crate::compensation::online::Sensor;
use crate::fit::force_sensor::store::StoredSensor;
use crate::ground::problem::{Outcome, Problem};
use crate::measurement::workspace::{Place, job_results};
use crate::path::programs::{EXPORTERS, Exporter};
use crate::process::Planned;
use crate::process::setup::Support;
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
    Ok(ending(&result))
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

fn act(arguments: &Arguments) -> Outcome<Corrected> {
    let request = Request {
        method: method(&arguments.method)?,
        exporter: Exporter::named(&arguments.program)?,
        plant: arguments.plant.as_deref().map(Planned::read).transpose()?,
        sensor: sensor(arguments.sensor.as_deref())?,
        support: arguments.support(),
    };
    correct(Planned::read(&arguments.job)?, request)
}

/// What correcting the part of a campaign found, with the robot that the campaign identified; written. Why it cannot
/// be corrected is a chapter too: what was measured stands without it.
///
/// # Errors
/// A job that cannot be read or planned, results that cannot be written.
pub fn chapter(place: &Place) -> Outcome<Option<Chapter>> {
    let Some(planned) = chapter::planned_part(place)? else {
        return Ok(None);
    };
    if planned.job.cutter.is_none() || planned.job.material.is_none() {
        return Ok(None);
    }
    let request = Request {
        method: &METHODS[0],
        exporter: &EXPORTERS[0],
        plant: None,
        sensor: Sensor::default(),
        support: Support::Coupled,
    };
    let title = format!("The part, corrected for {}", planned.job.robot);
    let input = |(path, hash): &(String, String)| (PathBuf::from(path), hash.clone());
    let inputs: Vec<(PathBuf, String)> = planned.inputs.iter().map(input).collect();
    let result = match correct(planned, request) {
        Ok(result) => result,
        Err(why) => return Ok(Some(Chapter::withheld(title, inputs[0].clone(), &why))),
    };
    write(&result)?;
    Ok(Some(Chapter {
        title,
        ending: ending(&result),
        inputs,
        page: page::page(&result),
    }))
}

fn ending(result: &Corrected) -> Ending {
    Ending::done_if(result.is_proven())
}

impl Arguments {
    fn support(&self) -> Support {
        match self.springs {
            true => Support::Static,
            false => Support::Coupled,
        }
    }
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

/// Writes everything, or nothing.
fn write(result: &Corrected) -> Outcome<Written> {
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
