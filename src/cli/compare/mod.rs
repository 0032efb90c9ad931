//! `ident compare`: two campaigns or two fits, what changed beyond its intervals, and which cause would explain it.

mod causes;
mod page;

use super::output::{print, print_result};
use super::{Ending, Verb, arguments, parsed};
use crate::fit::compare::{AnyFit, Comparison, Pair, read};
use crate::fit::parameter::Identified;
use crate::ground::problem::{Outcome, Problem};
use crate::report::folder;
use crate::report::json::number;
use crate::sheet::number::{ABSENT, significant, with_interval};
use clap::{ArgMatches, Args};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// The verb.
pub const VERB: Verb = Verb {
    name: "compare",
    about: "Compare two campaigns or two fits: what changed beyond its intervals, and which cause would explain it",
    arguments: arguments::<Arguments>,
    run,
};

#[derive(Args)]
struct Arguments {
    /// Before: a campaign, its folder, or a fit (fits/<campaign>/<file>.toml)
    before: PathBuf,
    /// After: the same
    after: PathBuf,
    /// Print one JSON document instead of the account
    #[arg(long)]
    json: bool,
    /// Write no report
    #[arg(long)]
    dry_run: bool,
}

fn run(matches: &ArgMatches) -> Outcome<Ending> {
    let arguments: Arguments = parsed(matches);
    let sides = [&arguments.before, &arguments.after];
    let [before, after] = [fits(sides[0])?, fits(sides[1])?];
    let comparison = Comparison::of(&before, &after);
    if comparison.pairs.is_empty() {
        let what = format!("has no parameter in common with {}", sides[0].display());
        let remedy = "compare campaigns whose measurements have the same names, or two fits";
        return Err(Problem::new(what, remedy).in_file(sides[1]));
    }
    let names = sides.map(|side| side.display().to_string());
    let report = (!arguments.dry_run).then(|| folder_of(&names));
    if let Some(folder) = &report {
        folder::write_as(folder, "index.html", &page::page(&names, &comparison))?;
    }
    let page = report.map(|folder| folder.join("index.html"));
    match arguments.json {
        false => print(&text(&names, &comparison, page.as_deref()))?,
        true => {
            let all = before.iter().chain(&after);
            let inputs: Vec<(String, String)> = all
                .map(|fit| (fit.path.display().to_string(), fit.sha256.clone()))
                .collect();
            print_result("compare", &inputs, body(&comparison, page.as_deref()))?;
        }
    }
    Ok(Ending::done_if(comparison.changed().is_empty()))
}

/// The fits that a name means.
fn fits(named: &Path) -> Outcome<Vec<AnyFit>> {
    if named.is_file() {
        return read(named)?.map(|fit| vec![fit]).ok_or_else(|| {
            let remedy = "give a fit, as fits/kr210/axis6.toml";
            Problem::new("holds no parameters", remedy).in_file(named)
        });
    }
    let folder = folder_of_fits(named);
    let entries = std::fs::read_dir(&folder).into_iter().flatten().flatten();
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.path()).collect();
    files.retain(|path| path.extension().is_some_and(|ending| ending == "toml"));
    files.sort();
    let read = files.iter().map(|path| read(path));
    let found: Vec<AnyFit> = read
        .collect::<Outcome<Vec<_>>>()?
        .into_iter()
        .flatten()
        .collect();
    match found.is_empty() {
        false => Ok(found),
        true => {
            let remedy = "let `ident run` or `ident stiffness` identify it first, or give two fits";
            Err(Problem::new("has no fits", remedy).in_file(&folder))
        }
    }
}

/// `kr210`, `measurements/kr210` and `fits/kr210` are one campaign.
fn folder_of_fits(named: &Path) -> PathBuf {
    let campaign = named.file_name().unwrap_or_default();
    let parent = named.parent().unwrap_or(Path::new(""));
    let within = |folder: &str| parent.file_name().is_some_and(|name| name == folder);
    match (within("measurements"), within("fits")) {
        (true, _) => parent.with_file_name("fits").join(campaign),
        (_, true) => named.to_path_buf(),
        _ if named.is_dir() => named.to_path_buf(),
        _ => Path::new("fits").join(named),
    }
}

/// `reports/compare-before-after`.
fn folder_of(names: &[String; 2]) -> PathBuf {
    let stem = |name: &String| {
        let path = Path::new(name);
        let of_file = path.extension().is_some_and(|ending| ending == "toml");
        let parent = path.parent().and_then(Path::file_name).unwrap_or_default();
        let own = if of_file {
            path.file_stem()
        } else {
            path.file_name()
        };
        let own = own.unwrap_or_default().to_string_lossy().to_string();
        match of_file {
            true => format!("{}-{own}", parent.to_string_lossy()),
            false => own,
        }
    };
    let [before, after] = [stem(&names[0]), stem(&names[1])];
    Path::new("reports").join(format!("compare-{before}-{after}"))
}

/// A side as it is told.
fn told(side: &Identified) -> String {
    let interval = side.value.zip(side.ci95);
    let limit = || {
        side.limit95
            .map(|limit| format!("at most {}", significant(limit, 2)))
    };
    let told = interval.map(|(value, [low, high])| with_interval(value, low, high));
    told.or_else(limit).unwrap_or(ABSENT.into())
}

/// One change in words.
fn sentence(pair: &Pair) -> String {
    let [before, after] = &pair.sides;
    let share = before
        .value
        .zip(pair.change)
        .filter(|(value, _)| *value != 0.0);
    let share = share.map_or(String::new(), |(value, [change, _])| {
        format!(
            " ({}{} %)",
            if change > 0.0 { "+" } else { "" },
            significant(100.0 * change / value.abs(), 2)
        )
    });
    let errors = pair
        .in_errors()
        .map_or(String::new(), |n| significant(n.abs(), 2));
    format!(
        "{} of {} went from {} to {} {}{share}: {errors} standard errors.",
        before.name,
        before.site,
        told(before),
        told(after),
        before.unit
    )
}

/// The verdict in one sentence.
fn verdict(comparison: &Comparison) -> String {
    let judged = comparison
        .pairs
        .iter()
        .filter(|pair| pair.change.is_some())
        .count();
    match comparison.changed().len() {
        0 => format!("None of {judged} parameters changed beyond its intervals."),
        n => format!("{n} of {judged} parameters changed beyond their intervals."),
    }
}

fn text(names: &[String; 2], comparison: &Comparison, page: Option<&Path>) -> String {
    let mut said = format!("{} to {}: {}\n", names[0], names[1], verdict(comparison));
    for pair in comparison.changed() {
        said.push_str(&format!("  {}\n", sentence(pair)));
    }
    for line in causes::sentences(comparison) {
        said.push_str(&format!("{line}\n"));
    }
    for line in alone(names, comparison) {
        said.push_str(&format!("{line}\n"));
    }
    if let Some(page) = page {
        said.push_str(&format!("wrote {}\n", page.display()));
    }
    said
}

/// What one side alone has, a line for each side.
fn alone(names: &[String; 2], comparison: &Comparison) -> Vec<String> {
    let of = |side: usize| {
        let own = comparison.alone.iter().filter(|(at, _)| *at == side);
        let own: Vec<&str> = own.map(|(_, what)| what.as_str()).collect();
        (!own.is_empty()).then(|| format!("only in {}: {}", names[side], own.join(", ")))
    };
    [of(0), of(1)].into_iter().flatten().collect()
}

fn body(comparison: &Comparison, page: Option<&Path>) -> Value {
    let pair = |pair: &Pair| {
        let [before, after] = &pair.sides;
        json!({
            "fit": pair.fit,
            "name": before.name,
            "site": before.site,
            "unit": before.unit,
            "before": side(before),
            "after": side(after),
            "change": pair.change.map(|[change, _]| number(change)),
            "change_stderr": pair.change.map(|[_, error]| number(error)),
            "changed": pair.changed,
        })
    };
    let only = comparison.alone.iter();
    let side_of = |at: usize| if at == 0 { "before" } else { "after" };
    let only = only.map(|(at, what)| json!({"side": side_of(*at), "what": what}));
    json!({
        "parameters": comparison.pairs.iter().map(pair).collect::<Value>(),
        "changed": comparison.changed().len(),
        "explanation": causes::json(comparison),
        "only": only.collect::<Value>(),
        "report": page.map(|page| page.display().to_string()),
    })
}

fn side(side: &Identified) -> Value {
    json!({
        "value": side.value.map(number),
        "ci95": side.ci95.map(|ci| ci.map(number)),
        "status": side.status,
    })
}
