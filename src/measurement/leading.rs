//! What the leading lines of a CSV file say, read without its rows.

use super::front::Front;
use crate::ground::files;
use crate::ground::problem::{Outcome, Problem};
use std::io::{BufRead, BufReader, Read};
use std::path::Path;

/// The kind that the front matter of a CSV file names; only its leading lines are read.
pub fn kind_of(path: &Path) -> Outcome<Option<String>> {
    fact_of(path, "kind")
}

/// A text that the front matter of a CSV file states; only its leading lines are read.
pub fn fact_of(path: &Path, name: &str) -> Outcome<Option<String>> {
    Ok(front_of(path)?.text(name)?.map(str::to_string))
}

/// The front matter of a CSV file; only its leading lines are read.
pub fn front_of(path: &Path) -> Outcome<Front> {
    let unreadable = |e: std::io::Error| {
        Problem::new(
            format!("cannot be read ({e})"),
            "make it a readable file, or move it away",
        )
    };
    let (file, _) = files::open(path).map_err(|problem| Problem {
        file: None,
        ..problem
    })?;
    let mut text = String::new();
    for line in BufReader::new(file.take(1 << 20)).split(b'\n') {
        let line = String::from_utf8_lossy(&line.map_err(unreadable)?).to_string();
        let Some(fact) = line.trim_start_matches('\u{feff}').strip_prefix('#') else {
            break;
        };
        text.push_str(fact.strip_prefix(' ').unwrap_or(fact));
        text.push('\n');
    }
    Front::parse(text)
}
