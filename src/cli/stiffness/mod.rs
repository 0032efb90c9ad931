//! `ident stiffness`: load/unload cycles become stiffnesses with backlash and hysteresis.

mod cubes;
mod json;
mod page;
mod tables;

pub use cubes::chapter as cubes_chapter;

use super::chapter::Chapter;
use super::output::{located, print, tell};
use super::progress::Progress;
use super::validate;
use super::{Ending, Verb, arguments, from_words, parsed};
use crate::effects::Composite;
use crate::fit::stiffness::{Account, DEFAULT_EFFECTS, Request, identify};
use crate::fit::store::StoredFit;
use crate::ground::files;
use crate::ground::problem::{Outcome, Problem};
use crate::measurement::load_cycle::LoadCycle;
use crate::measurement::workspace::Place;
use crate::report::{html, svg, text};
use crate::robot::load::load;
use crate::sheet::page::file;
use clap::{ArgMatches, Args};
use rayon::prelude::*;
use std::path::PathBuf;

/// The verb.
pub const VERB: Verb = Verb {
    name: "stiffness",
    about: "Identify stiffness, backlash and hysteresis from load/unload cycles, or a robot from measuring cubes",
    arguments: arguments::<Arguments>,
    run,
};

#[derive(Args)]
struct Arguments {
    /// Measurement files of kind load-cycle, or all of kind cubes; a bare name is looked up under measurements/
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// Print one JSON document instead of the account
    #[arg(long)]
    json: bool,
    /// Effects to fit beside the spring, separated by commas (`ident effects` lists them)
    #[arg(long, value_delimiter = ',', default_values_t = DEFAULT_EFFECTS.iter().map(|s| s.to_string()))]
    effects: Vec<String>,
    /// Start from the model of a fit that `stiffness` or `diagnose` wrote
    #[arg(long, value_name = "FIT", conflicts_with = "effects")]
    model: Option<PathBuf>,
    /// Intervals by block bootstrap with this many draws
    #[arg(long, default_value_t = 0, value_name = "N")]
    bootstrap: usize,
    /// Seed of the bootstrap
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Write no fits and no figures
    #[arg(long)]
    dry_run: bool,
    /// Report progress on standard error even without a terminal
    #[arg(long)]
    progress: bool,
}

/// One file with its account.
struct Result {
    file: LoadCycle,
    place: Place,
    account: Account,
}

fn run(matches: &ArgMatches) -> Outcome<Ending> {
    let arguments: Arguments = parsed(matches);
    if let Some(files) = cubes::meant(&arguments.files)? {
        return cubes::run(&files, arguments.json, arguments.dry_run);
    }
    let results = act(&arguments)?;
    match arguments.json {
        true => print(&json::as_json(&results))?,
        false => print(&as_text(&results, arguments.dry_run))?,
    }
    for result in &results {
        for warning in &result.account.warnings {
            tell(&format!("{}: {warning}", result.file.path.display()));
        }
    }
    Ok(ending(&results))
}

/// Identifies every axis test of a campaign, and writes what it found.
///
/// # Errors
/// A file that cannot be read, results that cannot be written.
pub fn chapter(place: &Place) -> Outcome<Option<Chapter>> {
    let files = place.files_of("load-cycle")?;
    if files.is_empty() {
        return Ok(None);
    }
    let results = act(&from_words::<Arguments>(&files))?;
    let all: Vec<&Result> = results.iter().collect();
    Ok(Some(Chapter {
        title: "The axis tests".into(),
        ending: ending(&results),
        inputs: results
            .iter()
            .map(|r| (r.file.path.clone(), r.file.sha256.clone()))
            .collect(),
        page: page::page(&all),
    }))
}

fn act(arguments: &Arguments) -> Outcome<Vec<Result>> {
    let request = request(arguments)?;
    let paths = paths(arguments)?;
    let progress = Progress::new(paths.len(), arguments.progress);
    let results = paths.into_par_iter().map(|path| {
        let name = path.display().to_string();
        let result = one(path, &request);
        progress.done(&name);
        result
    });
    let results: Vec<Outcome<Result>> = results.collect();
    progress.finish();
    // of several bad files the first is named, whichever thread was faster
    let results = results.into_iter().collect::<Outcome<Vec<Result>>>()?;
    if !arguments.dry_run {
        write(&results)?;
    }
    Ok(results)
}

fn request(arguments: &Arguments) -> Outcome<Request> {
    let names: Vec<&str> = arguments
        .effects
        .iter()
        .map(|s| s.trim())
        .filter(|s| !s.is_empty())
        .collect();
    let model = match &arguments.model {
        Some(path) => {
            StoredFit::read(path)?
                .model()
                .map_err(|p| p.in_text(path))?
                .0
        }
        None => Composite::named(&names)?,
    };
    Ok(Request {
        model,
        bootstrap: arguments.bootstrap,
        seed: arguments.seed,
    })
}

/// The files meant. Two that would write the same results are refused, unless nothing is written.
fn paths(arguments: &Arguments) -> Outcome<Vec<PathBuf>> {
    let mut paths: Vec<PathBuf> = Vec::new();
    for name in &arguments.files {
        let path = located(name)?;
        if !arguments.dry_run {
            Place::nameable(&path)?;
        }
        let same = |other: &&PathBuf| {
            Place::of(other) == Place::of(&path) && other.file_stem() == path.file_stem()
        };
        match paths.iter().find(same) {
            Some(other) if *other != path && !arguments.dry_run => {
                return Err(Problem::new(
                    format!("its results would overwrite those of {}", other.display()),
                    "put the files under measurements/<campaign>/, rename one, or add --dry-run",
                )
                .in_file(&path));
            }
            Some(other) if *other == path => {}
            _ => paths.push(path),
        }
    }
    Ok(paths)
}

fn one(path: PathBuf, request: &Request) -> Outcome<Result> {
    let file = LoadCycle::read(&path)?;
    let account = identify(&file, request);
    Ok(Result {
        place: Place::of(&path),
        file,
        account,
    })
}

/// 1 when something needs attention: no stiffness, or data that are odd.
fn ending(results: &[Result]) -> Ending {
    Ending::done_if(results.iter().all(|r| r.account.is_fine()))
}

fn write(results: &[Result]) -> Outcome<()> {
    let fits = results.par_iter().map(|result| {
        let folder = result.place.fits();
        let path = folder.join(format!("{}.toml", result.file.stem()));
        Ok((path, stored(result).text()?))
    });
    let mut inked = fits.collect::<Outcome<Vec<_>>>()?;
    for group in places(results) {
        inked.extend(ink(&group)?);
    }
    files::replace_texts(&inked)?;
    places(results)
        .into_iter()
        .try_for_each(|group| collect(group[0]))
}

/// Brings the identified robot of the campaign up to date. A campaign whose robot is not known
/// here has none.
fn collect(result: &Result) -> Outcome<()> {
    let Some(name) = result.file.facts.robot.as_deref() else {
        return Ok(());
    };
    match load(name, Some(&result.file.path)) {
        Ok(base) if !result.place.campaign.is_empty() => {
            validate::collect(&result.place, &base, result.file.facts.synthetic)
        }
        _ => Ok(()),
    }
}

/// The results of each campaign.
fn places(results: &[Result]) -> Vec<Vec<&Result>> {
    let mut groups: Vec<Vec<&Result>> = Vec::new();
    for result in results {
        match groups.iter_mut().find(|g| g[0].place == result.place) {
            Some(group) => group.push(result),
            None => groups.push(vec![result]),
        }
    }
    groups
}

/// The page of one campaign: several files share `stiffness.html`, one alone has its own.
fn page_path(results: &[&Result]) -> PathBuf {
    let name = match results {
        [one] => format!("{}-stiffness.html", one.file.stem()),
        _ => "stiffness.html".into(),
    };
    results[0].place.reports().join(name)
}

fn ink(results: &[&Result]) -> Outcome<Vec<(PathBuf, String)>> {
    let page = page::page(results);
    let reports = results[0].place.reports();
    let figures = page.figures();
    let figures = figures.par_iter().map(|(stem, chart)| {
        let path = reports.join(file(stem, chart));
        Ok((path, svg::ink(chart)?))
    });
    let mut out = figures.collect::<Outcome<Vec<_>>>()?;
    out.push((page_path(results), html::ink(&page)?));
    Ok(out)
}

fn stored(result: &Result) -> StoredFit {
    let account = &result.account;
    let (model, p) = (&account.solution.model, &account.solution.p);
    StoredFit {
        parameters: account.parameters.clone(),
        ..StoredFit::of(&result.file, model, p, &account.data.scene)
    }
}

fn as_text(results: &[Result], dry: bool) -> String {
    let all: Vec<&Result> = results.iter().collect();
    let mut said = tables::tables(&all)
        .iter()
        .map(text::table)
        .collect::<Vec<_>>()
        .join("\n");
    if !dry {
        for group in places(results) {
            said.push_str(&format!(
                "fits {}, report {}\n",
                group[0].place.fits().display(),
                page_path(&group).display()
            ));
        }
    }
    said
}
