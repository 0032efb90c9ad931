//! `ident sensor`: what a force-torque sensor reads of its tool, its offsets and its hose.

mod apply;
mod json;
mod page;
mod tables;

use super::chapter::Chapter;
use super::output::{located, print, tell};
use super::{Ending, Verb, arguments, from_words, parsed};
use crate::fit::force_sensor::model::Model;
use crate::fit::force_sensor::store::StoredSensor;
use crate::fit::force_sensor::{Account, identify};
use crate::fit::parameter::Status;
use crate::fit::suitability::{self, Doubt, is_odd};
use crate::ground::files;
use crate::ground::problem::{Outcome, Problem};
use crate::measurement::force_sensor::SensorTest;
use crate::measurement::workspace::Place;
use crate::report::{folder, text};
use apply::Applied;
use clap::{ArgMatches, Args};
use std::path::{Path, PathBuf};

/// The verb.
pub const VERB: Verb = Verb {
    name: "sensor",
    about: "Weight, centre of mass, offsets and turn of a force-torque sensor; correct a record with them",
    arguments: arguments::<Arguments>,
    run,
};

#[derive(Args)]
struct Arguments {
    /// Files of kind force-sensor, all of one sensor with one tool; or, with --apply, a model that was written
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// Record of kind force-sensor to correct: what remains is the load of the process
    #[arg(long, value_name = "RECORD")]
    apply: Option<PathBuf>,
    /// Print one JSON document instead of the account
    #[arg(long)]
    json: bool,
    /// Write no model, no record and no report
    #[arg(long)]
    dry_run: bool,
}

/// Everything that is reported.
struct Identified {
    tests: Vec<SensorTest>,
    place: Place,
    account: Account,
    applied: Option<Applied>,
    doubts: Vec<Doubt>,
}

fn run(matches: &ArgMatches) -> Outcome<Ending> {
    let arguments: Arguments = parsed(matches);
    if let [file] = &arguments.files[..]
        && file.extension().is_some_and(|e| e == "toml")
    {
        return only_apply(file, &arguments);
    }
    let found = examine(&arguments)?;
    if !arguments.dry_run {
        write(&found)?;
    }
    match arguments.json {
        true => print(&json::document(&found, arguments.dry_run))?,
        false => print(&said(&found, arguments.dry_run))?,
    }
    for remark in found.remarks() {
        tell(&format!("note: {remark}"));
    }
    Ok(found.ending())
}

fn examine(arguments: &Arguments) -> Outcome<Identified> {
    let tests = arguments.files.iter().map(|name| read(name));
    let tests = tests.collect::<Outcome<Vec<_>>>()?;
    let mut doubts = Vec::new();
    for test in &tests {
        doubts.extend(passed(test)?);
    }
    let account = identify(&tests)?;
    let record = arguments.apply.as_deref();
    let applied = record.map(|record| applied(record, &account.model));
    Ok(Identified {
        place: Place::of(&tests[0].path),
        tests,
        applied: applied.transpose()?,
        account,
        doubts,
    })
}

/// Identifies every force sensor of a campaign by itself, and writes what that found.
///
/// # Errors
/// A file that cannot be read, results that cannot be written.
pub fn chapter(place: &Place) -> Outcome<Option<Chapter>> {
    let one = |file: PathBuf| {
        let found = examine(&from_words::<Arguments>(&[file]))?;
        write(&found)?;
        Ok(Chapter {
            title: found.stem(),
            ending: found.ending(),
            inputs: found.tests.iter().map(SensorTest::input).collect(),
            page: page::page(&found),
        })
    };
    Chapter::of_each(place, "The force sensor", passed, one)
}

/// What is odd about a test that can carry a number.
fn passed(test: &SensorTest) -> Outcome<Vec<Doubt>> {
    let doubts = suitability::force_sensor::doubts(test);
    suitability::refuse(&test.path, &doubts)?;
    Ok(doubts)
}

fn read(name: &Path) -> Outcome<SensorTest> {
    SensorTest::read(&located(name)?)
}

fn applied(record: &Path, model: &Model) -> Outcome<Applied> {
    Ok(Applied::of(read(record)?, model))
}

/// Corrects a record with a model on disk.
fn only_apply(file: &Path, arguments: &Arguments) -> Outcome<Ending> {
    let stored = StoredSensor::read(file)?;
    let Some(record) = &arguments.apply else {
        return Err(Problem::new(
            "is a model, and nothing is to be corrected with it",
            "add --apply RECORD",
        )
        .in_file(file));
    };
    let applied = applied(
        record,
        &stored.model().map_err(|p| p.at_key(file, "values"))?,
    )?;
    if !arguments.dry_run {
        files::replace(&applied.path(), applied.text().as_bytes())?;
    }
    match arguments.json {
        true => print(&json::of_record(file, &applied, arguments.dry_run)?)?,
        false => print(&format!("{}\n", applied.sentence(arguments.dry_run)))?,
    }
    Ok(Ending::Done)
}

impl Identified {
    fn ending(&self) -> Ending {
        let known = &self.account.fitted.known[..10];
        Ending::done_if(known.iter().all(|known| *known) && !is_odd(&self.doubts))
    }

    fn stem(&self) -> String {
        self.tests[0].stem()
    }

    fn synthetic(&self) -> bool {
        self.tests.iter().any(|test| test.facts.synthetic)
    }

    fn model_path(&self) -> PathBuf {
        self.place
            .fits()
            .join(format!("{}-sensor.toml", self.stem()))
    }

    fn report(&self) -> String {
        format!("{}-sensor.html", self.stem())
    }

    fn remarks(&self) -> Vec<String> {
        let mut said: Vec<String> = self.doubts.iter().map(Doubt::sentence).collect();
        let open = |range: std::ops::Range<usize>| {
            let lost = self.account.parameters[range]
                .iter()
                .filter(|p| p.status != Status::Identified);
            lost.map(|p| p.name.as_str()).collect::<Vec<_>>().join(", ")
        };
        let (basic, angles) = (open(0..10), open(10..15));
        if !basic.is_empty() {
            said.push(format!("these orientations do not fix {basic}: turning about the vertical only, weight and offset are one; measure with z of the sensor up, down and level"));
        }
        if !angles.is_empty() {
            said.push(format!("these orientations do not fix {angles}: taken as 0 ± 0.5 degrees, which the other intervals hold"));
        }
        let left_out: usize = self.tests.iter().map(|test| test.left_out).sum();
        if left_out > 0 {
            said.push(format!("{left_out} rows were left out for an empty cell"));
        }
        said
    }
}

fn write(found: &Identified) -> Outcome<()> {
    let inputs = found.tests.iter().map(SensorTest::provenance).collect();
    let stored = StoredSensor::of(&found.account, inputs, found.synthetic()).text()?;
    let mut files = vec![(found.model_path(), stored)];
    files.extend(
        found
            .applied
            .as_ref()
            .map(|applied| (applied.path(), applied.text())),
    );
    let page = page::page(found);
    folder::write_with(files, &found.place.reports(), &found.report(), &page)?;
    Ok(())
}

fn said(found: &Identified, dry: bool) -> String {
    let mut said = format!("{}\n\n", tables::sentence(found));
    said += &text::table(&tables::parameters(found));
    said += "\n";
    said += &text::table(&tables::next(found));
    if let Some(applied) = &found.applied {
        said += &format!("\n{}\n", applied.sentence(dry));
    }
    if !dry {
        let report = found.place.reports().join(found.report());
        said += &format!(
            "\nmodel {}, report {}\n",
            found.model_path().display(),
            report.display()
        );
    }
    said
}
