//! Which column of a raw file is which.

use super::greet;
use super::talk::Talk;
use crate::cli::import::needs::{Column, columns};
use crate::ground::problem::{Outcome, Problem};
use crate::ground::units::split_name;
use crate::measurement::foreign::sidecar::{Sidecar, Source};
use crate::measurement::foreign::translated;
use crate::measurement::hammer_uff::is_universal;
use crate::measurement::table::Table;
use std::path::Path;

/// Titles of the raw file and what each became; nothing where the file says itself what it holds.
fn titles(path: &Path, sidecar: &Sidecar) -> Vec<(String, Option<String>)> {
    if is_universal(path) {
        return Vec::new();
    }
    if let Ok(Some(reading)) = translated(path, sidecar) {
        return reading.columns;
    }
    // Titles that tell nothing are seen where one column is named by its number.
    let mut probe = sidecar.clone();
    probe.columns.push(("time_s".into(), Source::Number(1)));
    let found = translated(path, &probe).ok().flatten();
    let columns = found.map_or(Vec::new(), |reading| reading.columns);
    columns
        .into_iter()
        .map(|(title, _)| (title, None))
        .collect()
}

/// Names of the columns as they will be read.
pub(super) fn names(path: &Path, sidecar: &Sidecar) -> Vec<String> {
    match translated(path, sidecar) {
        Ok(Some(reading)) => reading
            .columns
            .into_iter()
            .filter_map(|column| column.1)
            .collect(),
        _ => Table::read(path).map_or(Vec::new(), |table| {
            table.columns.into_iter().map(|c| c.name).collect()
        }),
    }
}

/// Asks for the columns that the kind needs and that no title tells.
pub(super) fn map(
    path: &Path,
    sidecar: &mut Sidecar,
    kind: &str,
    greeted: &mut bool,
    talk: &mut Talk,
) -> Outcome<()> {
    let titles = titles(path, sidecar);
    let known: Vec<(String, Source)> = titles
        .iter()
        .enumerate()
        .filter_map(|(i, (_, name))| Some((name.clone()?, Source::Number(i + 1))))
        .collect();
    let told = |column: &Column| {
        known
            .iter()
            .any(|(name, _)| column.stems.contains(&stem(name)))
    };
    let open: Vec<&Column> = columns(kind)
        .iter()
        .filter(|column| !told(column))
        .collect();
    if titles.is_empty() || open.is_empty() {
        return Ok(());
    }
    greet(path, greeted, talk)?;
    for (i, (title, name)) in titles.iter().enumerate() {
        let became = name
            .as_ref()
            .map_or(String::new(), |name| format!(" = {name}"));
        talk.say(&format!("  {} `{title}`{became}\n", i + 1))?;
    }
    let mut columns = known.clone();
    for column in open {
        let question = format!(
            "{}: number of its column, and its name if not {}",
            column.what, column.name
        );
        if let Some(found) = talk.ask(&question, |answer| mapped(answer, column, titles.len()))? {
            columns.push(found);
        }
    }
    if columns.len() > known.len() {
        sidecar.columns = columns;
    }
    Ok(())
}

fn stem(name: &str) -> &str {
    name.split('_').next().unwrap_or(name)
}

/// `2`, or `2 force_kN`.
fn mapped(answer: &str, column: &Column, count: usize) -> Outcome<(String, Source)> {
    let (number, name) = answer.split_once(' ').unwrap_or((answer, column.name));
    let name = name.trim();
    let split = split_name(name);
    if !split.is_some_and(|(stem, _)| column.stems.contains(&stem.as_str())) {
        let what = format!("`{name}` is no name of this column");
        return Err(Problem::new(
            what,
            format!("write one with its unit, as {}", column.name),
        ));
    }
    match number.parse() {
        Ok(n) if (1..=count).contains(&n) => Ok((name.into(), Source::Number(n))),
        _ => Err(Problem::new(
            format!("`{number}` is no column"),
            format!("give 1 to {count}"),
        )),
    }
}
