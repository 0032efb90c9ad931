//! `ident stiffness`: load/unload cycles become stiffnesses with backlash and hysteresis.

use super::output::{print, tell};
use super::progress::Progress;
use super::validate;
use super::{Ending, Verb, arguments, parsed};
use crate::effects::Composite;
use crate::experiments::load_cycle::Curves;
use crate::fit::parameter::{Identified, Status};
use crate::fit::stiffness::{Account, DEFAULT_EFFECTS, Request, identify};
use crate::fit::store::{SCHEMA, StoredFit, stored_effects, stored_scale};
use crate::ground::files;
use crate::ground::problem::{Outcome, Problem};
use crate::measurement::load_cycle::{Axis, LoadCycle, Port};
use crate::measurement::workspace::{Place, resolve};
use crate::report::{html, json, svg, text};
use crate::robot::load::load;
use crate::sheet::chart::Chart;
use crate::sheet::number::{ABSENT, engineering, fixed, prefix, significant};
use crate::sheet::page::{Block, Page, file};
use crate::sheet::table::Table;
use clap::{ArgMatches, Args};
use rayon::prelude::*;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// The verb.
pub const VERB: Verb = Verb {
    name: "stiffness",
    about: "Identify stiffness, backlash and hysteresis from load/unload cycles",
    arguments: arguments::<Arguments>,
    run,
};

#[derive(Args)]
struct Arguments {
    /// Measurement files of kind load-cycle; a bare name is looked up under measurements/
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
    let request = request(&arguments)?;
    let paths = paths(&arguments)?;
    let progress = Progress::new(paths.len(), arguments.progress);
    let results: Vec<Outcome<Result>> = paths
        .into_par_iter()
        .map(|path| {
            let name = path.display().to_string();
            let result = one(path, &request);
            progress.done(&name);
            result
        })
        .collect();
    progress.finish();
    // of several bad files the first is named, whichever thread was faster
    let results = results.into_iter().collect::<Outcome<Vec<Result>>>()?;
    if !arguments.dry_run {
        write(&results)?;
    }
    match arguments.json {
        true => print(&as_json(&results))?,
        false => print(&as_text(&results, arguments.dry_run))?,
    }
    for result in &results {
        for warning in &result.account.warnings {
            tell(&format!("{}: {warning}", result.file.path.display()));
        }
    }
    Ok(ending(&results))
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
                .map_err(|p| p.in_file(path))?
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
        let (path, said) = resolve(name)?;
        said.iter().for_each(|s| tell(s));
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

/// 1 when something needs attention: no stiffness, or a straight line that misleads.
fn ending(results: &[Result]) -> Ending {
    let supported = |r: &Result| r.account.parameters[0].status == Status::Identified;
    match results.iter().all(supported) {
        true => Ending::Done,
        false => Ending::Attention,
    }
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
    let inked: Vec<(&Path, &[u8])> = inked
        .iter()
        .map(|(path, content)| (path.as_path(), content.as_bytes()))
        .collect();
    files::replace_all(&inked)?;
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
    let page = page(results);
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

/// The report: the stiffnesses beside the nominal ones, then each file with its figure.
fn page(results: &[&Result]) -> Page {
    let first = results[0];
    let title = match results {
        [one] => format!("Stiffness of {}", one.file.stem()),
        _ => "Identified stiffness".into(),
    };
    let subtitle = match (results, first.place.campaign.as_str()) {
        ([one], _) => format!("{}, {} rows", one.file.site(), one.file.load.len()),
        (_, "") => format!("{} files", results.len()),
        (_, campaign) => format!("{} files of campaign {campaign}", results.len()),
    };
    let mut page = Page::new(title, subtitle);
    page.synthetic = results.iter().any(|r| r.file.facts.synthetic);
    page = page.with(Block::heading("Stiffness, beside the present simulation"));
    for table in tables(results) {
        page = page.with(Block::Table(table));
    }
    let noted = || results.iter().filter(|r| !r.account.warnings.is_empty());
    if noted().next().is_some() {
        page = page.with(Block::heading("What needs attention"));
    }
    for result in noted() {
        let said = format!(
            "{}: {}.",
            result.file.stem(),
            result.account.warnings.join("; ")
        );
        page = page.with(Block::text(said));
    }
    page = page.with(Block::heading("Files"));
    for result in results {
        let mut inside = vec![Block::Table(parameters_table(result))];
        if result.account.parameters[0].status == Status::Identified {
            inside.insert(0, Block::Chart(chart(result)));
        }
        page = match results {
            [_] => inside.into_iter().fold(page, Page::with),
            _ => page.with(Block::details(
                format!("{} ({})", result.file.stem(), result.file.site()),
                inside,
            )),
        };
    }
    page
}

/// Load cycles with the fitted model, and what lies beyond its spring.
fn chart(result: &Result) -> Chart {
    let account = &result.account;
    let scene = &account.data.scene;
    let (load, reading) = match account.imposed {
        false => (&scene.load, &account.data.reading),
        true => (&account.data.reading, &scene.load),
    };
    let model = fitted(account);
    let spring: Vec<f64> = match account.imposed {
        false => scene
            .load
            .iter()
            .map(|m| m / account.solution.p[0])
            .collect(),
        true => vec![0.0; scene.load.len()],
    };
    let beyond = match account.imposed {
        false => format!("{} − spring", result.file.port.deflection_name()),
        true => result.file.port.load_name().to_string(),
    };
    let curves = Curves {
        file: &result.file,
        time: &scene.time,
        load,
        reading,
        model: &model,
        name: "fitted model",
        reference: (&beyond, &spring),
        imposed: account.imposed,
    };
    let stem = format!("{}-stiffness", result.file.stem());
    curves.chart(&stem, "load cycles and fitted model")
}

/// Everything that was identified in one file.
fn parameters_table(result: &Result) -> Table {
    let mut table = Table::new(
        format!("What was identified in {}", result.file.stem()),
        ["parameter", "value", "95 % interval", "meaning"],
    )
    .numeric([1, 2]);
    for parameter in &result.account.parameters {
        let unit = if parameter.unit == "1" {
            ""
        } else {
            &parameter.unit
        };
        let value = match (parameter.value, parameter.limit95, parameter.status) {
            (Some(value), ..) => engineering(value, 5, unit),
            (None, Some(limit), _) => format!("< {}", engineering(limit, 2, unit)),
            (None, None, Status::AtBound) => "at its bound".into(),
            _ => "not identifiable".into(),
        };
        let interval = parameter.ci95.map_or(ABSENT.into(), |[low, high]| {
            let (factor, unit) = prefix(low.abs().max(high.abs()), unit);
            let end = |v: f64| significant(v * factor, 5);
            format!("{} to {} {unit}", end(low), end(high))
        });
        table.push([
            parameter.name.replace('_', " "),
            value,
            interval,
            parameter.meaning.clone(),
        ]);
    }
    table
}

fn fitted(account: &Account) -> Vec<f64> {
    account
        .data
        .reading
        .iter()
        .zip(&account.solution.residual)
        .map(|(y, r)| y - r)
        .collect()
}

fn stored(result: &Result) -> StoredFit {
    let account = &result.account;
    StoredFit {
        schema: SCHEMA.into(),
        version: env!("CARGO_PKG_VERSION").into(),
        input: result
            .file
            .path
            .file_name()
            .map(|n| n.to_string_lossy().to_string())
            .unwrap_or_default(),
        input_sha256: result.file.sha256.clone(),
        synthetic: result.file.facts.synthetic,
        site: result.file.site(),
        model: stored_effects(&account.solution.model, &account.solution.p),
        scale: stored_scale(&account.data.scene),
        parameters: account.parameters.clone(),
    }
}

fn as_json(results: &[Result]) -> String {
    let inputs: Vec<(&Path, &str)> = results
        .iter()
        .map(|r| (r.file.path.as_path(), r.file.sha256.as_str()))
        .collect();
    let mut map = json::head("stiffness", &inputs);
    map.insert(
        "results".into(),
        Value::Array(results.iter().map(result_json).collect()),
    );
    json::print(map)
}

fn result_json(result: &Result) -> Value {
    let account = &result.account;
    let axis = match result.file.facts.axis {
        Some(Axis::Tilt) => json!("tilt"),
        Some(Axis::Rotation) => json!("rotation"),
        None => Value::Null,
    };
    json!({
        "file": result.file.path.display().to_string(),
        "joint": result.file.facts.joint,
        "axis": axis,
        "synthetic": result.file.facts.synthetic,
        "effects": account.solution.model.effects().iter().map(|e| e.card().name).collect::<Vec<_>>(),
        "parameters": account.parameters,
        "straight_line": {
            "stiffness": finite(account.straight),
            "unit": result.file.port.stiffness_unit(),
            "differs_percent": straight_difference(account),
        },
        "measured_loss_per_cycle_J": account.losses,
        "imposed": if account.imposed { "displacement" } else { "load" },
        "branches": branches(account),
        "second_sensor_excess": account.second.map(|s| json!({"value": s.0, "stderr": s.1})),
        "fit": {
            "rms": account.solution.rms,
            "noise_rms": account.noise_rms,
            "noise": account.noise,
            "unit": if account.imposed { result.file.port.load_unit() } else { result.file.port.deflection_unit() },
            "rows": result.file.load.len(),
            "rows_left_out": result.file.left_out,
            "rows_replaced": account.data.wild.len(),
        },
        "warnings": account.warnings,
    })
}

/// Points of each branch of a settled cycle in the JSON.
const BRANCH_POINTS: usize = 24;

/// Unloading and loading branch of one settled cycle at full load: [load, deflection].
fn branches(account: &Account) -> Value {
    let Some((load, deflection)) = &account.branches else {
        return Value::Null;
    };
    let middle = load.len() / 2;
    let branch = |from: usize, to: usize| {
        let step = ((to - from) / BRANCH_POINTS).max(1);
        (from..=to)
            .step_by(step)
            .map(|i| [load[i], deflection[i]])
            .collect::<Vec<_>>()
    };
    json!({"unloading": branch(0, middle), "loading": branch(middle, load.len() - 1)})
}

fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

fn straight_difference(account: &Account) -> Option<f64> {
    let fitted = account.parameters.first()?.value?;
    finite(100.0 * (account.straight / fitted - 1.0))
}

/// Columns of the table: heading, parameter name.
const COLUMNS: &[(&str, &str)] = &[
    ("stiffness", "stiffness"),
    ("backlash", "backlash"),
    ("loss per cycle", "hysteresis_loss"),
    ("loss factor", "loss_factor"),
];

fn as_text(results: &[Result], dry: bool) -> String {
    let all: Vec<&Result> = results.iter().collect();
    let mut said = tables(&all)
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

/// One table for each kind of quantity: joints that turn, springs that are pressed.
fn tables(results: &[&Result]) -> Vec<Table> {
    let of = |port: Port| results.iter().copied().filter(move |r| r.file.port == port);
    [Port::Rotational, Port::Linear]
        .into_iter()
        .map(|port| of(port).collect::<Vec<_>>())
        .filter(|results| !results.is_empty())
        .map(|results| table(&results))
        .collect()
}

fn table(results: &[&Result]) -> Table {
    let found = |r: &Result, name: &str| {
        let parameters = &r.account.parameters;
        parameters.iter().find(|p| p.name == name).cloned()
    };
    let units: Vec<(f64, String)> = COLUMNS
        .iter()
        .map(|(_, name)| unit(results.iter().filter_map(|r| found(r, name))))
        .collect();
    let mut header = vec!["file".to_string(), "site".to_string()];
    for ((heading, _), (_, unit)) in COLUMNS.iter().zip(&units) {
        header.extend([format!("{heading} {unit}").trim().to_string(), "± %".into()]);
    }
    let stiffness = &units[0];
    header.insert(4, format!("nominal {}", stiffness.1));
    header.push("straight line".into());
    let synthetic = results.iter().any(|r| r.file.facts.synthetic);
    let label = if synthetic { " (synthetic data)" } else { "" };
    let title = format!("Identified stiffness{label}");
    let numeric: Vec<usize> = (2..header.len()).collect();
    let mut table = Table::new(title, header).numeric(numeric);
    for result in results {
        let mut cells = vec![result.file.stem(), result.file.site()];
        for ((_, name), (factor, _)) in COLUMNS.iter().zip(&units) {
            cells.extend(cell(found(result, name).as_ref(), *factor));
        }
        let nominal = result.file.facts.nominal_stiffness;
        cells.insert(
            4,
            nominal.map_or(ABSENT.into(), |k| significant(k * stiffness.0, 4)),
        );
        let line = straight_difference(&result.account);
        cells.push(line.map_or(ABSENT.into(), signed_percent));
        table.push(cells);
    }
    table
        .noted(format!(
            "± %: half of the 95 % interval; <: 95 % limit of what was not found; {ABSENT}: not known"
        ))
        .noted("straight line: by how much a line through all readings misses the stiffness")
}

/// `+1.2 %`, `-1.2 %`, and `0.0 %` for what rounds to it.
fn signed_percent(value: f64) -> String {
    match fixed(value, 1) {
        text if value > 0.0 && text != "0.0" => format!("+{text} %"),
        text => format!("{text} %"),
    }
}

/// Factor and unit in which the smallest value of a column is shown; the others have the same.
fn unit(parameters: impl Iterator<Item = Identified>) -> (f64, String) {
    let mut smallest: Option<(f64, String)> = None;
    for parameter in parameters {
        let value = parameter.value.or(parameter.limit95).map_or(0.0, f64::abs);
        let less = smallest.as_ref().is_none_or(|s| value < s.0 || s.0 == 0.0);
        if smallest.is_none() || (less && value > 0.0) {
            smallest = Some((value, parameter.unit));
        }
    }
    match smallest {
        Some((_, unit)) if unit == "1" => (1.0, String::new()),
        Some((value, unit)) => prefix(value, &unit),
        None => (1.0, String::new()),
    }
}

/// Value and half of its interval in percent.
fn cell(parameter: Option<&Identified>, factor: f64) -> [String; 2] {
    let Some(parameter) = parameter else {
        return [ABSENT.into(), String::new()];
    };
    match (parameter.value, parameter.ci95, parameter.limit95) {
        (Some(value), Some([low, high]), _) => {
            let half = 50.0 * (high - low) / value.abs();
            [significant(value * factor, 4), significant(half, 2)]
        }
        (None, _, Some(limit)) => [
            format!("< {}", significant(limit * factor, 2)),
            String::new(),
        ],
        _ => [ABSENT.into(), String::new()],
    }
}
