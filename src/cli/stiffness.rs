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
use crate::measurement::load_cycle::{Axis, LoadCycle};
use crate::measurement::workspace::{Place, resolve};
use crate::report::{json, svg, text};
use crate::robot::load::load;
use crate::sheet::number::{engineering, significant};
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
    let inked: Vec<(PathBuf, String)> = results
        .par_iter()
        .map(ink)
        .collect::<Outcome<Vec<_>>>()?
        .concat();
    let inked: Vec<(&Path, &[u8])> = inked
        .iter()
        .map(|(path, content)| (path.as_path(), content.as_bytes()))
        .collect();
    files::replace_all(&inked)?;
    let mut places: Vec<&Result> = results.iter().collect();
    places.dedup_by(|a, b| a.place == b.place);
    places.into_iter().try_for_each(collect)
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

fn ink(result: &Result) -> Outcome<Vec<(PathBuf, String)>> {
    let stem = result.file.stem();
    let mut out = vec![(
        result.place.fits().join(format!("{stem}.toml")),
        stored(result).text()?,
    )];
    if result.account.parameters[0].status == Status::Identified {
        let model: Vec<f64> = fitted(&result.account);
        let data = &result.account.data;
        let (load, reading) = match result.account.imposed {
            false => (&data.scene.load, &data.reading),
            true => (&data.reading, &data.scene.load),
        };
        let curves = Curves {
            file: &result.file,
            time: &result.account.data.scene.time,
            load,
            reading,
            model: &model,
            name: "fitted model",
            imposed: result.account.imposed,
        };
        let chart = curves.chart(&format!("{stem}-stiffness"), "load cycles and fitted model");
        out.push((
            result.place.reports().join(format!("{stem}-stiffness.svg")),
            svg::ink(&chart)?,
        ));
    }
    Ok(out)
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
    ("secant", "secant_stiffness"),
    ("backlash", "backlash"),
    ("loss/cycle", "hysteresis_loss"),
    ("loss factor", "loss_factor"),
];

fn as_text(results: &[Result], dry: bool) -> String {
    let mut header = vec!["file".to_string(), "site".to_string()];
    header.extend(COLUMNS.iter().map(|c| c.0.to_string()));
    header.extend(["textbook line".to_string(), "nominal".to_string()]);
    let synthetic = results.iter().any(|r| r.file.facts.synthetic);
    let title = if synthetic {
        "Identified stiffness (synthetic data)"
    } else {
        "Identified stiffness"
    };
    let numeric: Vec<usize> = (2..header.len()).collect();
    let mut table = Table::new(title, header).numeric(numeric);
    for result in results {
        table.push(row(result));
    }
    table = table
        .noted("value ± half of the 95 % interval; `<` is the 95 % limit of what was not found");
    let mut said = text::table(&table);
    if !dry {
        for folder in folders(results) {
            said.push_str(&format!("fits and figures under {folder}\n"));
        }
    }
    said
}

fn folders(results: &[Result]) -> Vec<String> {
    let mut folders: Vec<String> = results
        .iter()
        .map(|r| {
            format!(
                "{} and {}",
                r.place.fits().display(),
                r.place.reports().display()
            )
        })
        .collect();
    folders.dedup();
    folders
}

fn row(result: &Result) -> Vec<String> {
    let account = &result.account;
    let mut cells = vec![result.file.stem(), result.file.site()];
    for (_, name) in COLUMNS {
        let parameter = account.parameters.iter().find(|p| p.name == *name);
        cells.push(parameter.map_or("–".into(), cell));
    }
    let line = straight_difference(account).map_or("–".into(), |d| {
        format!(
            "{} ({d:+.1} %)",
            engineering(account.straight, 4, result.file.port.stiffness_unit())
        )
    });
    cells.push(line);
    let nominal = result.file.facts.nominal_stiffness;
    cells.push(nominal.map_or("–".into(), |k| {
        engineering(k, 4, result.file.port.stiffness_unit())
    }));
    cells
}

fn cell(parameter: &Identified) -> String {
    let unit = if parameter.unit == "1" {
        ""
    } else {
        &parameter.unit
    };
    match (parameter.value, parameter.ci95, parameter.limit95) {
        (Some(value), Some([low, high]), _) => {
            let half = 50.0 * (high - low) / value.abs();
            format!(
                "{} ± {} %",
                engineering(value, 4, unit),
                significant(half, 2)
            )
        }
        (None, _, Some(limit)) => format!("< {}", engineering(limit, 2, unit)),
        _ => "not identifiable".into(),
    }
}
