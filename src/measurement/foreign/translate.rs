//! A raw file in the form that the reader of tables knows, with what each of its columns became.

use super::header::{Head, cells, find, number};
use super::sidecar::{Sidecar, Source};
use super::{encoding, titles};
use crate::ground::problem::{Outcome, Problem};
use sha2::{Digest, Sha256};
use std::fmt::Write;
use std::path::Path;

/// How a raw file was read.
#[derive(Debug, Clone, PartialEq)]
pub struct Reading {
    /// Front matter, header and rows as [`crate::measurement::table`] reads them.
    pub text: String,
    /// SHA-256 of the raw file.
    pub sha256: String,
    /// Its encoding.
    pub encoding: &'static str,
    /// Lines before its titles.
    pub skipped: usize,
    /// 1-based line of the first row of numbers in the raw file.
    pub first_line: usize,
    /// Lines before the first row in `text`.
    pub shift: usize,
    /// Title, and what it became; `None`: passed over.
    pub columns: Vec<(String, Option<String>)>,
}

/// Largest raw file that is translated in memory, bytes.
const LARGEST: u64 = 2 << 30;

/// Translates a file that is not in the form of `ident`; `None` where it is.
///
/// # Errors
/// It cannot be read, or no table is found in it.
pub fn translated(path: &Path, sidecar: &Sidecar) -> Outcome<Option<Reading>> {
    let size = std::fs::metadata(path).map_or(0, |m| if m.is_file() { m.len() } else { u64::MAX });
    if size > LARGEST || (!sidecar.maps() && is_native(path)) {
        return Ok(None);
    }
    let Ok(bytes) = std::fs::read(path) else {
        return Ok(None);
    };
    if bytes.starts_with(b"PK") || bytes.is_empty() {
        return Ok(None);
    }
    let (text, encoding) = encoding::decoded(&bytes, sidecar.encoding.as_deref())?;
    let lines: Vec<&str> = text.lines().collect();
    let wanted: Vec<String> = sidecar
        .columns
        .iter()
        .filter_map(|c| titled(&c.1))
        .collect();
    match find(&lines, sidecar.skip_rows.unwrap_or(0), &wanted) {
        Some(head) => {
            let sha256 = Sha256::digest(&bytes)
                .iter()
                .map(|b| format!("{b:02x}"))
                .collect();
            reading(&lines, &head, sidecar, (sha256, encoding)).map(Some)
        }
        None if sidecar.maps() => Err(no_table()),
        None => Ok(None),
    }
}

fn titled(source: &Source) -> Option<String> {
    match source {
        Source::Title(title) => Some(title.clone()),
        Source::Number(_) => None,
    }
}

fn no_table() -> Problem {
    let remedy = "name the lines before the titles as `skip_rows`, and the titles under `[columns]`, in the sidecar";
    Problem::new("no row of titles over numbers is found", remedy).at_line(1)
}

/// Whether the first line that is no fact is a header of this program.
fn is_native(path: &Path) -> bool {
    use std::io::{BufRead, BufReader, Read};
    let Ok(file) = std::fs::File::open(path) else {
        return true;
    };
    let mut line = Vec::new();
    let mut reader = BufReader::new(file.take(1 << 20));
    loop {
        line.clear();
        match reader.read_until(b'\n', &mut line) {
            Ok(0) | Err(_) => return true,
            Ok(_) if line.starts_with(b"#") || line.trim_ascii().is_empty() => {}
            Ok(_) => break,
        }
    }
    let Ok(header) = std::str::from_utf8(&line) else {
        return false;
    };
    let header = header.trim_start_matches('\u{feff}');
    if header.starts_with('#') {
        return true;
    }
    let delimiter = ['\t', ';', ',']
        .into_iter()
        .find(|d| header.contains(*d))
        .unwrap_or(',');
    let plain = |c: &String| {
        c.starts_with(|l: char| l.is_ascii_lowercase())
            && titles::name_of(c, None).is_some_and(|name| name == *c)
    };
    // one native name is enough: what is wrong with the others is for the reader of tables to say
    cells(header, delimiter).iter().any(plain)
}

fn reading(
    lines: &[&str],
    head: &Head,
    sidecar: &Sidecar,
    (sha256, encoding): (String, &'static str),
) -> Outcome<Reading> {
    let names = names(head, sidecar)?;
    let chosen: Vec<usize> = (0..names.len()).filter(|i| names[*i].is_some()).collect();
    let facts: Vec<&str> = lines
        .iter()
        .copied()
        .take_while(|l| l.starts_with('#'))
        .collect();
    let mut text = facts.join("\n");
    if !facts.is_empty() {
        text.push('\n');
    }
    let title: Vec<&str> = chosen.iter().filter_map(|i| names[*i].as_deref()).collect();
    let _ = writeln!(text, "{}", title.join(";"));
    for line in &lines[head.first_line..] {
        row(&mut text, line, head, &chosen);
    }
    Ok(Reading {
        text,
        sha256,
        encoding,
        skipped: head.titles_line,
        first_line: head.first_line + 1,
        shift: facts.len() + 1,
        columns: head.titles.iter().cloned().zip(names).collect(),
    })
}

/// One row; of another length as it stands, so that the reader of tables refuses it by its line.
fn row(text: &mut String, line: &str, head: &Head, chosen: &[usize]) {
    let own = cells(line, head.delimiter);
    if own.iter().all(String::is_empty) {
        text.push('\n');
        return;
    }
    let cell = |i: &usize| {
        own.get(*i).map_or(String::from("?"), |c| {
            number(c).unwrap_or_else(|| c.clone())
        })
    };
    let cells: Vec<String> = chosen.iter().map(cell).collect();
    let _ = writeln!(text, "{}", cells.join(";"));
}

/// What each title becomes: by the mapping where there is one, else by its words.
fn names(head: &Head, sidecar: &Sidecar) -> Outcome<Vec<Option<String>>> {
    let mut names = vec![None; head.titles.len()];
    for (name, source) in &sidecar.columns {
        let at = match source {
            Source::Number(n) => Some(n - 1).filter(|i| *i < names.len()),
            Source::Title(title) => head.titles.iter().position(|t| t == title),
        };
        let Some(at) = at else {
            let titles: Vec<String> = head.titles.iter().map(|t| format!("`{t}`")).collect();
            let what = format!("the column of `{name}` is not among the titles");
            let remedy = format!(
                "correct `[columns]` in the sidecar; the titles are {}",
                titles.join(", ")
            );
            return Err(Problem::new(what, remedy).at_line(head.titles_line + 1));
        };
        names[at] = Some(name.clone());
    }
    if sidecar.columns.is_empty() {
        let below = |i: usize| {
            head.units
                .as_ref()
                .and_then(|u| u.get(i))
                .map(String::as_str)
        };
        names = (0..names.len())
            .map(|i| titles::name_of(&head.titles[i], below(i)))
            .collect();
        names = names
            .into_iter()
            .map(|n: Option<String>| n.map(lower_stem))
            .collect();
    }
    Ok(names)
}

/// `Force_N` is `force_N`.
fn lower_stem(name: String) -> String {
    match name.split_once('_') {
        Some((stem, rest)) => format!("{}_{rest}", stem.to_lowercase()),
        None => name.to_lowercase(),
    }
}
