//! `ident diagnose`: what the simulation gets wrong, and why.

mod campaign;
mod next;
mod page;
mod tables;

use super::output::{located, print};
use super::progress::Progress;
use super::run::place;
use super::{Ending, Verb, arguments, parsed};
use crate::findings::campaign::DiagnosedFile;
use crate::findings::kinds::{kind, load_cycle};
use crate::findings::sentence::sentences;
use crate::ground::files::replace_texts;
use crate::ground::problem::{Outcome, Problem};
use crate::measurement::workspace::Place;
use crate::report::json::body;
use crate::report::{folder, html, svg, text};
use crate::sheet::page::file;
use clap::{ArgMatches, Args};
use rayon::prelude::*;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// The verb.
pub const VERB: Verb = Verb {
    name: "diagnose",
    about: "Show what the simulation gets wrong, name the cause, and measure the gain on unseen data",
    arguments: arguments::<Arguments>,
    run,
};

#[derive(Args)]
struct Arguments {
    /// Measurement files (a bare name is looked up under measurements/), or the folder of a campaign
    #[arg(required_unless_present = "next")]
    files: Vec<PathBuf>,
    /// Simulate load cycles with the model of a fit that `stiffness` or `diagnose` wrote
    #[arg(long, value_name = "FIT")]
    model: Option<PathBuf>,
    /// Plan the next N set-ups on the whole robot instead, by the information each would bring; takes a
    /// workspace file or a folder, without either the only campaign under measurements/
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=50))]
    next: Option<u16>,
    /// Print one JSON document instead of the account
    #[arg(long)]
    json: bool,
    /// Write no model and no report
    #[arg(long)]
    dry_run: bool,
    /// Report progress on standard error even without a terminal
    #[arg(long)]
    progress: bool,
}

pub use campaign::chapter;

fn run(matches: &ArgMatches) -> Outcome<Ending> {
    let arguments: Arguments = parsed(matches);
    if let Some(count) = arguments.next {
        return next::run(&arguments, usize::from(count));
    }
    if let [folder] = &arguments.files[..]
        && folder.is_dir()
    {
        if arguments.model.is_some() {
            return Err(misplaced("this is the folder of a campaign").in_file(folder));
        }
        return whole(&place(Some(folder))?, &arguments);
    }
    let progress = Progress::new(arguments.files.len(), arguments.progress);
    let results = arguments.files.par_iter().map(|name| {
        let one = one(name, arguments.model.as_deref());
        progress.done(&name.display().to_string());
        one
    });
    let results = results.collect::<Outcome<Vec<DiagnosedFile>>>()?;
    progress.finish();
    if !arguments.dry_run {
        replace_texts(&written(&results)?)?;
    }
    let said = match arguments.json {
        true => as_json(&results, arguments.dry_run)?,
        false => as_text(&results, arguments.dry_run)?,
    };
    print(&said)?;
    let fine = |one: &DiagnosedFile| one.found.answer().is_fine();
    Ok(Ending::done_if(results.iter().all(fine)))
}

fn misplaced(what: &str) -> Problem {
    let remedy = "leave out --model, or give load cycles of the joint that was fitted";
    Problem::new(
        format!("--model is for single load cycles, and {what}"),
        remedy,
    )
}

fn one(name: &Path, fit: Option<&Path>) -> Outcome<DiagnosedFile> {
    let path = located(name)?;
    let (kind, diagnose) = kind(&path)?;
    let found = match fit {
        None => diagnose(&path)?,
        Some(fit) if kind == "load-cycle" => load_cycle::diagnosed_with(&path, fit)?,
        Some(_) => return Err(misplaced(&format!("this is of kind `{kind}`")).in_file(&path)),
    };
    Ok(DiagnosedFile {
        kind,
        place: Place::of(&path),
        found,
    })
}

fn report(file: &DiagnosedFile) -> PathBuf {
    let reports = file.place.reports();
    reports.join(format!("{}-diagnosis.html", file.stem()))
}

/// Everything that is written for a file.
fn results(diagnosed: &DiagnosedFile) -> Outcome<Vec<(PathBuf, String)>> {
    let page = page::page(diagnosed.found.as_ref(), &diagnosed.stem());
    let mut out: Vec<(PathBuf, String)> = diagnosed.model()?.into_iter().collect();
    for (stem, chart) in page.figures() {
        let figure = diagnosed.place.reports().join(file(&stem, chart));
        out.push((figure, svg::ink(chart)?));
    }
    out.push((report(diagnosed), html::ink(&page)?));
    Ok(out)
}

/// A whole campaign.
fn whole(place: &Place, arguments: &Arguments) -> Outcome<Ending> {
    let campaign = campaign::examine(place, arguments.progress)?;
    if !arguments.dry_run {
        let files = campaign::written(&campaign)?;
        let story = campaign::story(&campaign);
        folder::write_with(files, &place.reports(), "diagnosis.html", &story)?;
    }
    let said = match arguments.json {
        true => {
            let sources: Vec<_> = campaign.files.iter().map(|r| r.found.source()).collect();
            let inputs: Vec<(&Path, &str)> = sources.iter().map(|s| (s.path, s.sha256)).collect();
            let mut map = crate::report::json::head("diagnose", &inputs);
            map.extend(body(&campaign.document(!arguments.dry_run)?));
            crate::report::json::print(map)
        }
        false => campaign::account(&campaign),
    };
    print(&said)?;
    Ok(campaign::ending(&campaign))
}

/// What is written for these files.
fn written(files: &[DiagnosedFile]) -> Outcome<Vec<(PathBuf, String)>> {
    files
        .iter()
        .try_for_each(|one| Place::nameable(one.path()))?;
    let inked: Vec<Vec<(PathBuf, String)>> =
        files.par_iter().map(results).collect::<Outcome<_>>()?;
    Ok(inked.concat())
}

fn as_text(results: &[DiagnosedFile], dry: bool) -> Outcome<String> {
    let mut said = String::new();
    for one in results {
        said.push_str(&account(one));
        if results.len() == 1 {
            said.push_str(&tables_of(one));
        }
        if !dry {
            if let Some((path, _)) = one.model()? {
                said.push_str(&format!("  model  {}\n", path.display()));
            }
            said.push_str(&format!("  report {}\n", report(one).display()));
        }
    }
    Ok(said)
}

fn account(one: &DiagnosedFile) -> String {
    let (answer, source) = (one.found.answer(), one.found.source());
    let label = if source.synthetic { " (synthetic)" } else { "" };
    let head = format!(
        "{}{label}: {}\n",
        source.path.display(),
        answer.verdict.name()
    );
    let mut said: Vec<String> = sentences(answer);
    said.extend(one.found.present());
    said.extend(one.found.remarks());
    said.iter().fold(head, |all, s| all + &text::indented(s, 2))
}

fn tables_of(one: &DiagnosedFile) -> String {
    let answer = one.found.answer();
    let mut said = String::new();
    if !answer.causes.is_empty() || !answer.groups.is_empty() {
        said.push_str(&format!("\n{}", text::table(&tables::causes_table(answer))));
    }
    if !answer.candidates.is_empty() {
        said.push_str(&format!(
            "\n{}",
            text::table(&tables::candidates_table(answer))
        ));
    }
    said
}

fn as_json(results: &[DiagnosedFile], dry: bool) -> Outcome<String> {
    let sources: Vec<_> = results.iter().map(|r| r.found.source()).collect();
    let inputs: Vec<(&Path, &str)> = sources.iter().map(|s| (s.path, s.sha256)).collect();
    let mut map = crate::report::json::head("diagnose", &inputs);
    match results {
        [one] => map.extend(body(&one.document(!dry)?)),
        many => {
            let with_file = |one: &DiagnosedFile| {
                let mut map = body(&one.document(!dry)?);
                map.insert("file".into(), json!(one.path().display().to_string()));
                Ok(Value::Object(map))
            };
            map.insert(
                "results".into(),
                many.iter().map(with_file).collect::<Outcome<_>>()?,
            );
        }
    }
    Ok(crate::report::json::print(map))
}
