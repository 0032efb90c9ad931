//! A raw file in the form that the reader of tables knows, with what each of its columns became.

use super::binary::Sheet;
use super::header::{Head, cells, find, number};
use super::sidecar::{Sidecar, Source};
use super::{binary, encoding, titles};
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
    /// Its encoding, or the format of a file that is no text.
    pub encoding: &'static str,
    /// Sheet, group or variable of a file that holds several.
    pub sheet: Option<String>,
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
    if bytes.is_empty() {
        return Ok(None);
    }
    if let Some(format) = binary::format_of(&bytes) {
        let sheet = chosen(format.read(&bytes)?, sidecar)?;
        let lines: Vec<&str> = sheet.text.lines().collect();
        let head = head(&lines, sidecar).ok_or_else(|| unnamed(&lines))?;
        let mut reading = reading(&lines, &head, sidecar, (hash(&bytes), format.name))?;
        reading.sheet = Some(sheet.name);
        return Ok(Some(reading));
    }
    if bytes.starts_with(b"PK") {
        return Ok(None);
    }
    let (text, encoding) = encoding::decoded(&bytes, sidecar.encoding.as_deref())?;
    let lines: Vec<&str> = text.lines().collect();
    match head(&lines, sidecar) {
        Some(head) => reading(&lines, &head, sidecar, (hash(&bytes), encoding)).map(Some),
        None if sidecar.maps() => Err(no_table()),
        None => Ok(None),
    }
}

fn hash(bytes: &[u8]) -> String {
    Sha256::digest(bytes)
        .iter()
        .map(|b| format!("{b:02x}"))
        .collect()
}

fn head(lines: &[&str], sidecar: &Sidecar) -> Option<Head> {
    let wanted = sidecar.columns.iter().filter_map(|c| titled(&c.1));
    let wanted: Vec<String> = wanted.collect();
    let mapped = !sidecar.columns.is_empty();
    let from = sidecar.skip_rows.unwrap_or(0);
    match mapped && wanted.is_empty() {
        // columns by their numbers alone: any titles will do
        true => find(lines, from, &[String::new()]),
        false => find(lines, from, &wanted),
    }
}

/// The table that is meant: the one named, else the only one, else the only one whose titles are understood.
fn chosen(sheets: Vec<Sheet>, sidecar: &Sidecar) -> Outcome<Sheet> {
    let names: Vec<String> = sheets.iter().map(|sheet| sheet.name.clone()).collect();
    let is_meant = |sheet: &Sheet| match &sidecar.table {
        Some(name) => sheet.name == *name,
        None => {
            let lines: Vec<&str> = sheet.text.lines().collect();
            names.len() == 1 || head(&lines, sidecar).is_some()
        }
    };
    let mut meant = sheets.into_iter().filter(is_meant);
    match (meant.next(), meant.next()) {
        (Some(sheet), None) => Ok(sheet),
        _ => Err(several(&names, sidecar.table.as_deref())),
    }
}

fn several(names: &[String], asked: Option<&str>) -> Problem {
    let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    let what = match asked {
        Some(name) => format!("holds no table `{name}`"),
        None => "holds more than one table, and the titles do not tell which is meant".into(),
    };
    let remedy = format!(
        "name one with `ident import FILE --table NAME`: {}; and its columns with --column NAME=TITLE",
        quoted.join(", ")
    );
    Problem::new(what, remedy).at_line(1)
}

/// No title of a table is understood: all of them are asked for at once.
fn unnamed(lines: &[&str]) -> Problem {
    let titles = lines.iter().find(|line| !line.trim().is_empty());
    let titles = titles.map_or(Vec::new(), |line| cells(line, binary::DELIMITER));
    let titles: Vec<String> = titles.iter().take(40).map(|t| format!("`{t}`")).collect();
    let remedy = "say what they are: `ident import FILE --column time_s=1 --column force_N=2 ...`";
    let what = format!(
        "has columns whose titles tell no quantity and unit: {}",
        titles.join(", ")
    );
    Problem::new(what, remedy).at_line(1)
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
        sheet: None,
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
