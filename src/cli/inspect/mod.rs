//! `ident inspect`: what was understood of a measurement file, and what looks odd. One file per kind.

mod hammer;
mod job;
mod load_cycle;
mod table;
mod toolpath;
mod universal;
mod workspace;

use super::output::{located, print};
use super::{Ending, Verb, arguments, parsed};
use crate::findings::kinds::KINDS;
use crate::ground::problem::Outcome;
use crate::measurement::hammer_uff::is_universal;
use crate::measurement::leading::{front_of, kind_of};
use crate::report::json;
use clap::{ArgMatches, Args};
use serde_json::{Map, Value};
use std::path::{Path, PathBuf};

/// The verb.
pub const VERB: Verb = Verb {
    name: "inspect",
    about: "Show what was understood of a measurement file, and what looks odd",
    arguments: arguments::<Arguments>,
    run,
};

#[derive(Args)]
struct Arguments {
    /// A measurement file of any kind, a tool path or a job
    file: PathBuf,
    /// Print one JSON document
    #[arg(long)]
    json: bool,
}

/// What is said of a file.
struct Account {
    /// For the reader, one line each.
    lines: Vec<String>,
    /// The same as JSON.
    json: Map<String, Value>,
    /// What looks odd.
    odd: Vec<String>,
}

type Reader = fn(&Path) -> Outcome<Account>;

/// The kinds with an account of their own; of every other kind that a verb knows, the columns are told.
const OWN: &[(&str, Reader)] = &[
    ("load-cycle", load_cycle::account),
    ("workspace", workspace::account),
    ("hammer", hammer::account),
    ("path", toolpath::account),
];

/// Kinds that `ident` writes, and paths: nothing diagnoses them, and they can be looked at.
const WRITTEN: &[&str] = &["path", "trajectory", "course"];

/// Whether an ending is that of a form.
type EndingTest = fn(&str) -> bool;

/// Files that are no tables: who looks at them, and whether it does, by the ending.
const ENDINGS: &[(Reader, EndingTest)] = &[
    (job::account, |ending| ending == "toml"),
    (toolpath::account, toolpath::has_ending),
];

fn run(matches: &ArgMatches) -> Outcome<Ending> {
    let arguments: Arguments = parsed(matches);
    let path = located(&arguments.file)?;
    let mut account = reader(&path)?(&path)?;
    let odd = account.odd.iter().map(|odd| format!("odd: {odd}"));
    account.lines.extend(odd);
    account
        .json
        .insert("odd".into(), account.odd.clone().into());
    print(&match arguments.json {
        true => json::print(account.json),
        false => account.lines.join("\n") + "\n",
    })?;
    Ok(Ending::done_if(account.odd.is_empty()))
}

/// Who reads a file of this kind; a file that does not say its kind is taken for load cycles.
fn reader(path: &Path) -> Outcome<Reader> {
    if is_universal(path) {
        return Ok(universal::account);
    }
    if let Some(reader) = by_ending(path) {
        return Ok(reader);
    }
    let Some(kind) = kind_of(path).ok().flatten() else {
        return Ok(load_cycle::account);
    };
    let known: Vec<&str> = KINDS
        .iter()
        .map(|kind| kind.0)
        .chain(WRITTEN.iter().copied())
        .collect();
    let own = OWN
        .iter()
        .find(|(name, _)| *name == kind)
        .map(|(_, reader)| *reader);
    let plain = known
        .contains(&kind.as_str())
        .then_some(table::account as Reader);
    own.or(plain).ok_or_else(|| {
        let what = format!("is of kind `{kind}`, which `inspect` does not know");
        let remedy = format!(
            "it knows {}; correct `# kind`, if it is one of them",
            known.join(", ")
        );
        let placed = front_of(path).map(|front| front.problem("kind", what, remedy));
        placed.unwrap_or_else(|problem| problem).in_file(path)
    })
}

fn by_ending(path: &Path) -> Option<Reader> {
    let ending = path.extension()?.to_string_lossy().to_lowercase();
    let found = ENDINGS.iter().find(|(_, has)| has(&ending));
    found.map(|(reader, _)| *reader)
}

/// The first line of every account, and a second one for what nobody measured.
fn title(path: &Path, what: &str, synthetic: bool) -> Vec<String> {
    let mut lines = vec![format!("{}: {what}", path.display())];
    if synthetic {
        lines.push("synthetic: simulated, not measured".into());
    }
    lines
}

/// Joint angles in degrees, as far as they carry: 21.0375, not 21.037499999999998.
fn degrees(angles: &[f64]) -> Vec<f64> {
    let round = |q: &f64| (q / crate::ground::units::DEGREE * 1e9).round() / 1e9;
    angles.iter().map(round).collect()
}

/// `3`, or `2 to 3`.
fn span<T: PartialEq + std::fmt::Display>(low: T, high: T) -> String {
    match low == high {
        true => low.to_string(),
        false => format!("{low} to {high}"),
    }
}

/// Smallest and largest.
fn range(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| {
        [low.min(x), high.max(x)]
    })
}
