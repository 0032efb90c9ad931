//! `ident diagnose`: what the simulation gets wrong, and why.

use super::output::{print, tell};
use super::progress::Progress;
use super::{Ending, Verb, arguments, parsed};
use crate::experiments::load_cycle::Curves;
use crate::findings::{
    Diagnosis, Settings, Verdict, diagnose,
    sentence::{probability, sentence, sentences},
};
use crate::fit::store::{SCHEMA, StoredFit, stored_effects, stored_scale};
use crate::ground::files;
use crate::ground::problem::Outcome;
use crate::measurement::load_cycle::LoadCycle;
use crate::measurement::workspace::{Place, resolve};
use crate::report::{html, json, svg, text};
use crate::sheet::chart::{Axis, Chart, Panel, Series};
use crate::sheet::number::{engineering, prefix, significant};
use crate::sheet::page::{Block, Page, Tone, file};
use crate::sheet::table::Table;
use clap::{ArgMatches, Args};
use rayon::prelude::*;
use serde_json::{Map, Value, json};
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
    /// Measurement files of kind load-cycle; a bare name is looked up under measurements/
    #[arg(required = true)]
    files: Vec<PathBuf>,
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

struct Diagnosed {
    file: LoadCycle,
    place: Place,
    found: Diagnosis,
}

fn run(matches: &ArgMatches) -> Outcome<Ending> {
    let arguments: Arguments = parsed(matches);
    let progress = Progress::new(arguments.files.len(), arguments.progress);
    let results = arguments
        .files
        .par_iter()
        .map(|name| {
            let one = one(name);
            progress.done(&name.display().to_string());
            one
        })
        .collect::<Outcome<Vec<Diagnosed>>>()?;
    progress.finish();
    if !arguments.dry_run {
        write(&results)?;
    }
    let said = if arguments.json {
        as_json(&results, arguments.dry_run)
    } else {
        as_text(&results, arguments.dry_run)
    };
    print(&said)?;
    let fine = results
        .iter()
        .all(|r| r.found.verdict == Verdict::Sufficient);
    Ok(if fine {
        Ending::Done
    } else {
        Ending::Attention
    })
}

fn one(name: &Path) -> Outcome<Diagnosed> {
    let (path, said) = resolve(name)?;
    said.iter().for_each(|s| tell(s));
    let file = LoadCycle::read(&path)?;
    let found = diagnose(&file, &Settings::default());
    Ok(Diagnosed {
        place: Place::of(&path),
        file,
        found,
    })
}

impl Diagnosed {
    fn model_path(&self) -> PathBuf {
        self.place
            .fits()
            .join(format!("{}-extended.toml", self.file.stem()))
    }

    fn stored(&self) -> StoredFit {
        StoredFit {
            schema: SCHEMA.into(),
            version: env!("CARGO_PKG_VERSION").into(),
            input: self
                .file
                .path
                .file_name()
                .map(|n| n.to_string_lossy().to_string())
                .unwrap_or_default(),
            input_sha256: self.file.sha256.clone(),
            synthetic: self.file.facts.synthetic,
            site: self.file.site(),
            model: stored_effects(&self.found.model, &self.found.p),
            scale: stored_scale(&self.found.data.scene),
            parameters: Vec::new(),
        }
    }

    fn tone(&self) -> Tone {
        match self.found.verdict {
            Verdict::Sufficient => Tone::Good,
            Verdict::Explained => Tone::Neutral,
            Verdict::PartlyExplained | Verdict::CannotTell => Tone::Attention,
            Verdict::UnknownCause => Tone::Bad,
        }
    }
}

fn write(results: &[Diagnosed]) -> Outcome<()> {
    let inked: Vec<(PathBuf, String)> = results
        .par_iter()
        .map(ink)
        .collect::<Outcome<Vec<_>>>()?
        .concat();
    for (path, content) in inked {
        files::replace(&path, content.as_bytes())?;
    }
    Ok(())
}

fn ink(result: &Diagnosed) -> Outcome<Vec<(PathBuf, String)>> {
    let page = page(result);
    let reports = result.place.reports();
    let mut out = vec![(result.model_path(), result.stored().text()?)];
    for (stem, chart) in page.figures() {
        out.push((reports.join(file(&stem, chart)), svg::ink(chart)?));
    }
    out.push((
        reports.join(format!("{}-diagnosis.html", result.file.stem())),
        html::ink(&page)?,
    ));
    Ok(out)
}

/// The report: what is wrong, why, how sure, what it gained, what remains, what to measure next.
fn page(result: &Diagnosed) -> Page {
    let file = &result.file;
    let subtitle = format!(
        "{} of {}, from {}",
        file.site(),
        file.facts.robot.as_deref().unwrap_or("an unnamed robot"),
        file.path.file_name().unwrap_or_default().to_string_lossy()
    );
    let mut page = Page::new(format!("Diagnosis of {}", file.stem()), subtitle);
    page.synthetic = file.facts.synthetic;
    page = page
        .with(Block::verdict(result.tone(), sentence(&result.found)))
        .with(Block::heading(
            "What the simulation shows and what was measured",
        ))
        .with(Block::Chart(before_and_after(result)));
    if !result.found.causes.is_empty() || !result.found.groups.is_empty() {
        page = page
            .with(Block::heading("Why"))
            .with(Block::Table(causes_table(result)));
    }
    if !result.found.groups.is_empty() {
        page = page.with(Block::heading("What to measure next"));
        for group in &result.found.groups {
            let pair = group.effects.join(" from ");
            page = page.with(Block::text(format!(
                "To tell {pair}: {}.",
                group.would_tell
            )));
        }
    }
    if !result.found.candidates.is_empty() {
        page = page
            .with(Block::heading("What was compared"))
            .with(Block::Table(candidates_table(result)));
    }
    page = page
        .with(Block::heading("What remains"))
        .with(Block::text(left(result)))
        .with(Block::Chart(remaining(result)));
    page
}

/// Measured against simulated: the readings, what the present simulation misses and the extended
/// model explains, and what is left.
fn before_and_after(result: &Diagnosed) -> Chart {
    let found = &result.found;
    let (load, reading) = match found.imposed {
        false => (&found.data.scene.load, &found.data.reading),
        true => (&found.data.reading, &found.data.scene.load),
    };
    let beyond = format!(
        "{} − simulation",
        match found.imposed {
            false => result.file.port.deflection_name(),
            true => result.file.port.load_name(),
        }
    );
    let curves = Curves {
        file: &result.file,
        time: &found.data.scene.time,
        load,
        reading,
        model: &found.extended,
        name: "extended model",
        reference: (&beyond, &found.simulated),
        imposed: found.imposed,
    };
    let simulated = curves.prediction(&found.simulated);
    Chart::new(
        format!("{}-diagnosis", result.file.stem()),
        format!("{}: measured against simulated", result.file.site()),
        format!(
            "Load cycle {} of {}, {} rows. From top to bottom: the readings; what the present simulation misses, over load and over time; what is left with the named causes in the model.",
            result.file.stem(),
            result.file.facts.robot.as_deref().unwrap_or("an unnamed robot"),
            result.file.load.len()
        ),
    )
    .synthetic(result.file.facts.synthetic)
    .with(
        curves
            .loops()
            .with(Series::dashed("present simulation", simulated)),
    )
    .with(curves.beyond_over_load())
    .with(curves.beyond_over_time())
    .with(curves.residual_over_time())
}

fn remaining(result: &Diagnosed) -> Chart {
    let shape = &result.found.unexplained;
    let largest = shape
        .shape
        .iter()
        .chain(&shape.over_time)
        .fold(0.0_f64, |m, p| m.max(p[1].abs()));
    let load = result.found.data.scene.load_scale;
    let (ys, yu) = prefix(largest, result.found.unit);
    let (name, unit) = match result.found.imposed {
        false => (result.file.port.load_name(), result.file.port.load_unit()),
        true => (
            result.file.port.deflection_name(),
            result.file.port.deflection_unit(),
        ),
    };
    let (xs, xu) = prefix(load, unit);
    let scaled = |points: &[[f64; 2]], xs: f64| {
        points
            .iter()
            .map(|p| [p[0] * xs, p[1] * ys])
            .collect::<Vec<_>>()
    };
    let axis = || Axis::new("Mean residual", yu.clone());
    let noise = result.found.discrepancy.noise_rms * ys;
    let band = |points: &[[f64; 2]], xs: f64| {
        let edges: Vec<[f64; 3]> = points.iter().map(|p| [p[0] * xs, -noise, noise]).collect();
        Series::band("± noise of one reading", &edges)
    };
    Chart::new(
        format!("{}-remaining", result.file.stem()),
        "What no named cause explains",
        "Mean of measured − extended model in twelve bins of load and of time. The band, for scale, is the noise of one reading.",
    )
    .synthetic(result.file.facts.synthetic)
    .with(
        Panel::new(Axis::new(name, xu), axis())
            .with(band(&shape.shape, xs))
            .with(Series::line("mean residual", scaled(&shape.shape, xs))),
    )
    .with(
        Panel::new(Axis::new("Time", "s"), axis())
            .with(band(&shape.over_time, 1.0))
            .with(Series::line("mean residual", scaled(&shape.over_time, 1.0))),
    )
}

fn left(result: &Diagnosed) -> String {
    let percent = 100.0 * result.found.unexplained.share_of_variance;
    let share = match percent {
        p if p < 0.1 => "Less than 0.1".into(),
        p => significant(p, 2),
    };
    format!(
        "{share} % of the error's variance is left above the noise. The noise is {}.",
        result.found.noise
    )
}

fn causes_table(result: &Diagnosed) -> Table {
    let header = [
        "cause",
        "site",
        "probability",
        "parameters",
        "error without",
        "with it",
        "reduction [95 %]",
    ];
    let mut table =
        Table::new("Causes, with the error on data held out of the fit", header).numeric([2, 4, 5]);
    let unit = result.found.unit;
    for cause in &result.found.causes {
        let parameters: Vec<String> = cause
            .parameters
            .iter()
            .map(|(name, value, unit)| {
                format!(
                    "{name} {}",
                    engineering(*value, 3, if *unit == "1" { "" } else { unit })
                )
            })
            .collect();
        table.push([
            cause.effect.to_string(),
            cause.site.clone(),
            probability(cause.probability),
            parameters.join(", "),
            engineering(cause.gain.before, 3, unit),
            engineering(cause.gain.after, 3, unit),
            reduction(&cause.gain),
        ]);
    }
    for group in &result.found.groups {
        table.push([
            format!("one of {}", group.effects.join(", ")),
            distinct(&group.sites),
            "not told apart".into(),
            String::new(),
            engineering(group.gain.before, 3, unit),
            engineering(group.gain.after, 3, unit),
            reduction(&group.gain),
        ]);
    }
    table
}

fn distinct(sites: &[String]) -> String {
    let mut sites = sites.to_vec();
    sites.dedup();
    sites.join(", ")
}

fn reduction(gain: &crate::findings::gain::Gain) -> String {
    format!(
        "{:.1} % [{:.1}, {:.1}]",
        gain.reduction_percent, gain.ci95_percent[0], gain.ci95_percent[1]
    )
}

fn candidates_table(result: &Diagnosed) -> Table {
    let mut table = Table::new(
        "Sets of causes, most probable first",
        ["causes", "probability", "misfit explained in nats"],
    )
    .numeric([1, 2]);
    for (causes, probability, nats) in &result.found.candidates {
        let name = if causes.is_empty() {
            "none".to_string()
        } else {
            causes.join(" + ")
        };
        table.push([
            name,
            match 100.0 * probability {
                p if p < 0.01 => "< 0.01 %".into(),
                p => format!("{p:.2} %"),
            },
            format!("{nats:.1}"),
        ]);
    }
    table
}

fn as_text(results: &[Diagnosed], dry: bool) -> String {
    let mut said = String::new();
    for result in results {
        let label = if result.file.facts.synthetic {
            " (synthetic)"
        } else {
            ""
        };
        said.push_str(&format!(
            "{}{label}: {}\n",
            result.file.path.display(),
            result.found.verdict.name()
        ));
        for sentence in sentences(&result.found) {
            said.push_str(&text::indented(&sentence, 2));
        }
        if results.len() == 1 {
            if !result.found.causes.is_empty() || !result.found.groups.is_empty() {
                said.push_str(&format!("\n{}", text::table(&causes_table(result))));
            }
            if !result.found.candidates.is_empty() {
                said.push_str(&format!("\n{}", text::table(&candidates_table(result))));
            }
        }
        if !dry {
            let report = result
                .place
                .reports()
                .join(format!("{}-diagnosis.html", result.file.stem()));
            said.push_str(&format!(
                "  model  {}\n  report {}\n",
                result.model_path().display(),
                report.display()
            ));
        }
    }
    said
}

fn as_json(results: &[Diagnosed], dry: bool) -> String {
    let inputs: Vec<(&Path, &str)> = results
        .iter()
        .map(|r| (r.file.path.as_path(), r.file.sha256.as_str()))
        .collect();
    let mut map = json::head("diagnose", &inputs);
    map.insert("kind".into(), json!("load-cycle"));
    match results {
        [one] => map.extend(body(one, dry)),
        many => {
            let list = many.iter().map(|r| {
                let mut one = body(r, dry);
                one.insert("file".into(), json!(r.file.path.display().to_string()));
                Value::Object(one)
            });
            map.insert("results".into(), Value::Array(list.collect()));
        }
    }
    json::print(map)
}

fn body(result: &Diagnosed, dry: bool) -> Map<String, Value> {
    let found = &result.found;
    let mut map = Map::new();
    let mut put = |key: &str, value: Value| map.insert(key.into(), value);
    put("synthetic", json!(result.file.facts.synthetic));
    put("verdict", json!(found.verdict.name()));
    put("sentence", json!(sentence(found)));
    put(
        "discrepancy",
        json!({
            "rms": found.discrepancy.rms,
            "noise_rms": found.discrepancy.noise_rms,
            "unit": found.unit,
            "where": found.discrepancy.place,
            "noise": found.noise,
        }),
    );
    put("causes", causes_json(result));
    put("cannot_separate", groups_json(result));
    put(
        "unexplained",
        json!({
            "share_of_variance": found.unexplained.share_of_variance,
            "shape": found.unexplained.shape,
            "shape_over_time": found.unexplained.over_time,
            "p_value": found.adequacy.p_value,
            "description": found.unexplained.description,
        }),
    );
    let candidates = found
        .candidates
        .iter()
        .map(|(c, p, n)| json!({"effects": c, "probability": p, "nats": n}));
    put("candidates", Value::Array(candidates.collect()));
    put(
        "model",
        if dry {
            Value::Null
        } else {
            json!(result.model_path().display().to_string())
        },
    );
    map
}

fn gain_json(gain: &crate::findings::gain::Gain) -> Value {
    json!({
        "held_out_rms_before": gain.before,
        "held_out_rms_after": gain.after,
        "reduction_percent": gain.reduction_percent,
        "ci95_percent": gain.ci95_percent,
    })
}

fn causes_json(result: &Diagnosed) -> Value {
    let causes = result.found.causes.iter().map(|cause| {
        let alternatives: Vec<Value> = cause
            .alternatives
            .iter()
            .map(|(effect, probability)| json!({"effect": effect, "site": cause.site, "probability": probability}))
            .collect();
        let parameters: Vec<Value> = cause
            .parameters
            .iter()
            .map(|(name, value, unit)| json!({"name": name, "site": cause.site, "value": value, "unit": unit}))
            .collect();
        json!({
            "effect": cause.effect,
            "site": cause.site,
            "probability": cause.probability,
            "alternatives": alternatives,
            "parameters": parameters,
            "gain": gain_json(&cause.gain),
        })
    });
    Value::Array(causes.collect())
}

fn groups_json(result: &Diagnosed) -> Value {
    let groups = result.found.groups.iter().map(|group| {
        json!({
            "effects": group.effects,
            "sites": group.sites,
            "would_tell": group.would_tell,
            "gain": gain_json(&group.gain),
        })
    });
    Value::Array(groups.collect())
}
