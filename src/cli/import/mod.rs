//! `ident import`: how the raw files of other programs are read, kept as a sidecar beside each.

mod ask;
mod needs;

use super::output::print;
use super::{Ending, Verb, arguments, parsed};
use crate::findings::kinds::KINDS;
use crate::ground::files;
use crate::ground::problem::{Outcome, Problem};
use crate::measurement::foreign::sidecar::{Sidecar, Source, place};
use crate::measurement::foreign::{Reading, translated};
use crate::measurement::hammer_uff::is_universal;
use crate::measurement::table::Table;
use crate::measurement::uff;
use crate::report::json;
use ask::Talk;
use clap::{ArgMatches, Args};
use serde_json::{Map, Value, json};
use std::io::IsTerminal;
use std::path::{Path, PathBuf};

/// The verb.
pub const VERB: Verb = Verb {
    name: "import",
    about: "Show how raw files of other programs are read, and keep that beside them; at a terminal it asks for what is missing",
    arguments: arguments::<Arguments>,
    run,
};

#[derive(Args)]
struct Arguments {
    /// Raw files; the same reading is kept for all of them
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// Kind of the measurement, as load-cycle
    #[arg(long)]
    kind: Option<String>,
    /// A fact of the measurement, as joint=2, axis="rotation" or load_lever_m=1.2
    #[arg(long = "fact", value_name = "KEY=VALUE")]
    facts: Vec<String>,
    /// A column, as time_s="Zeit [s]", or by its number from 1: force_N=2
    #[arg(long = "column", value_name = "NAME=TITLE")]
    columns: Vec<String>,
    /// Lines before the titles that do not count
    #[arg(long)]
    skip_rows: Option<usize>,
    /// Encoding: utf-8, utf-16 or windows-1252; left out: by the bytes
    #[arg(long)]
    encoding: Option<String>,
    /// Sheet, group or variable, in a file of several tables
    #[arg(long, value_name = "NAME")]
    table: Option<String>,
    /// Print one JSON document
    #[arg(long)]
    json: bool,
    /// Write no sidecar
    #[arg(long)]
    dry_run: bool,
}

/// One file and how it is read.
struct Imported {
    path: PathBuf,
    sidecar: Sidecar,
    reading: Option<Reading>,
    rows: usize,
    missing: Vec<String>,
    sha256: String,
}

impl Imported {
    /// Writes what stands beside the file, if that is anything and not there already.
    fn write(&self) -> Outcome<()> {
        let is_there = Sidecar {
            shared: toml::Table::new(),
            ..Sidecar::beside(&self.path)?
        } == Sidecar {
            shared: toml::Table::new(),
            ..self.sidecar.clone()
        };
        match is_there {
            true => Ok(()),
            false => files::replace(&place(&self.path), self.sidecar.text().as_bytes()),
        }
    }
}

fn run(matches: &ArgMatches) -> Outcome<Ending> {
    let arguments: Arguments = parsed(matches);
    let (mut answers, mut questions) = (std::io::stdin().lock(), std::io::stderr());
    let mut talk = Talk::new(&mut answers, &mut questions);
    let asks = std::io::stdin().is_terminal() && !arguments.json;
    let each = arguments.files.iter().map(|path| {
        let talk = asks.then_some(&mut talk);
        imported(path, &arguments, talk)
    });
    let all = each.collect::<Outcome<Vec<Imported>>>()?;
    if !arguments.dry_run {
        all.iter().try_for_each(Imported::write)?;
    }
    print(&match arguments.json {
        true => document(&all),
        false => all.iter().map(account).collect(),
    })?;
    Ok(Ending::done_if(
        all.iter().all(|one| one.missing.is_empty()),
    ))
}

/// Reads a file; `talk`: who is asked for what nobody stated.
fn imported(path: &Path, arguments: &Arguments, talk: Option<&mut Talk>) -> Outcome<Imported> {
    let mut sidecar = asked(Sidecar::beside(path)?, arguments)?;
    if is_universal(path) {
        let hammer = || toml::Value::String("hammer".into());
        sidecar.facts.entry("kind").or_insert_with(hammer);
    }
    if let Some(talk) = talk {
        sidecar = ask::completed(path, sidecar, talk)?;
    }
    if is_universal(path) {
        return universal(path, sidecar);
    }
    let reading = translated(path, &sidecar).map_err(|p| p.in_file(path))?;
    let table = match &reading {
        Some(reading) => {
            Table::from_reader(path, reading.text.as_bytes(), reading.text.len() as u64)?
        }
        None => Table::read(path)?,
    };
    let mut facts = table.front.facts.clone();
    facts.extend(sidecar.shared.clone());
    facts.extend(sidecar.facts.clone());
    Ok(Imported {
        path: path.to_path_buf(),
        rows: table.rows,
        sha256: files::sha256(&files::read_bytes(path)?),
        missing: missing(&facts, &table),
        sidecar,
        reading,
    })
}

/// A universal file names its own columns; its facts are those of a hammer test.
fn universal(path: &Path, sidecar: Sidecar) -> Outcome<Imported> {
    let functions = uff::read(path)?.functions.len();
    let mut facts = sidecar.shared.clone();
    facts.extend(sidecar.facts.clone());
    let open = needs::missing(&facts, &[]);
    Ok(Imported {
        path: path.to_path_buf(),
        rows: functions,
        sha256: files::sha256(&files::read_bytes(path)?),
        missing: open.iter().map(|fact| fact.key.to_string()).collect(),
        sidecar,
        reading: None,
    })
}

/// What stands beside the file already, with what was typed.
fn asked(mut sidecar: Sidecar, arguments: &Arguments) -> Outcome<Sidecar> {
    if let Some(kind) = &arguments.kind {
        known_kind(kind)?;
        sidecar
            .facts
            .insert("kind".into(), toml::Value::String(kind.clone()));
    }
    for typed in &arguments.facts {
        let (key, value) = halves(typed, "--fact")?;
        sidecar.facts.insert(key.to_string(), value_of(value));
    }
    for typed in &arguments.columns {
        let (name, title) = halves(typed, "--column")?;
        let source = title
            .parse()
            .map_or(Source::Title(title.to_string()), Source::Number);
        sidecar.columns.retain(|c| c.0 != name);
        sidecar.columns.push((name.to_string(), source));
    }
    sidecar.skip_rows = arguments.skip_rows.or(sidecar.skip_rows);
    sidecar.table = arguments.table.clone().or(sidecar.table);
    sidecar.encoding = arguments.encoding.clone().or(sidecar.encoding);
    Ok(sidecar)
}

fn known_kind(kind: &str) -> Outcome<()> {
    let known: Vec<&str> = KINDS.iter().map(|k| k.0).collect();
    match known.contains(&kind) {
        true => Ok(()),
        false => Err(Problem::new(
            format!("`{kind}` is no kind"),
            format!("give one of {}", known.join(", ")),
        )),
    }
}

fn halves<'a>(typed: &'a str, option: &str) -> Outcome<(&'a str, &'a str)> {
    let halves = typed.split_once('=').map(|(k, v)| (k.trim(), v.trim()));
    halves
        .filter(|(k, v)| !k.is_empty() && !v.is_empty())
        .ok_or_else(|| {
            Problem::new(
                format!("`{option} {typed}` is not understood"),
                format!("write {option} KEY=VALUE"),
            )
        })
}

/// A number, a list or a text as TOML has it; anything else is a text.
fn value_of(text: &str) -> toml::Value {
    let document = format!("x = {text}").parse::<toml::Table>();
    let value = document.ok().and_then(|mut t| t.remove("x"));
    value.unwrap_or_else(|| toml::Value::String(text.to_string()))
}

/// Facts that the kind needs and that nobody stated: all at once.
fn missing(facts: &toml::Table, table: &Table) -> Vec<String> {
    let names: Vec<String> = table
        .columns
        .iter()
        .map(|column| column.name.clone())
        .collect();
    let open = needs::missing(facts, &names);
    open.iter().map(|fact| fact.key.to_string()).collect()
}

fn account(one: &Imported) -> String {
    let mut said = match &one.reading {
        None if is_universal(&one.path) => {
            format!(
                "{}: universal file, {} functions\n",
                one.path.display(),
                one.rows
            )
        }
        None => format!(
            "{}: already in the form of ident, {} rows\n",
            one.path.display(),
            one.rows
        ),
        Some(reading) => format!(
            "{}: {} rows below line {}, {}{}\n",
            one.path.display(),
            one.rows,
            reading.first_line - 1,
            reading.encoding,
            reading
                .sheet
                .as_ref()
                .map_or(String::new(), |s| format!(", table `{s}`"))
        ),
    };
    for (title, name) in one.reading.iter().flat_map(|r| &r.columns) {
        let became = name.as_deref().unwrap_or("passed over");
        said.push_str(&format!("  {title}: {became}\n"));
    }
    for (key, value) in &one.sidecar.facts {
        said.push_str(&format!("  {key} = {value}\n"));
    }
    if !one.missing.is_empty() {
        said.push_str(&format!(
            "  missing: {} (give each with --fact KEY=VALUE, or --kind)\n",
            one.missing.join(", ")
        ));
    }
    said
}

fn document(all: &[Imported]) -> String {
    let inputs: Vec<(&Path, &str)> = all
        .iter()
        .map(|one| (one.path.as_path(), one.sha256.as_str()))
        .collect();
    let mut map = json::head("import", &inputs);
    let results: Vec<Value> = all.iter().map(|one| Value::Object(body(one))).collect();
    map.insert("results".into(), results.into());
    json::print(map)
}

fn body(one: &Imported) -> Map<String, Value> {
    let columns = one.reading.iter().flat_map(|r| &r.columns);
    let columns: Vec<Value> = columns
        .map(|(title, name)| json!({"title": title, "name": name}))
        .collect();
    let mut map = Map::new();
    map.insert("file".into(), json!(one.path.display().to_string()));
    map.insert("rows".into(), json!(one.rows));
    let format = one.reading.as_ref().map(|r| r.encoding);
    let sheet = one.reading.as_ref().and_then(|r| r.sheet.clone());
    map.insert("format".into(), json!(format));
    map.insert("table".into(), json!(sheet));
    map.insert("columns".into(), columns.into());
    map.insert("facts".into(), json!(one.sidecar.facts));
    map.insert("missing".into(), json!(one.missing));
    map.insert(
        "sidecar".into(),
        json!(place(&one.path).display().to_string()),
    );
    map
}
