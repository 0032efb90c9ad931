//! Blocks of a universal file.

use super::binary;
use super::fields::Record;
use crate::ground::problem::{Outcome, Problem};

/// One block.
pub enum Block<'a> {
    /// Records of a data set.
    Text {
        /// The data set.
        set: u32,
        /// Its records, without type line and markers.
        records: Vec<Record<'a>>,
    },
    /// Data set 58b: its type line with 11 records, and its bytes.
    Binary(binary::Head<'a>, &'a [u8]),
}

/// Walks through the bytes of a file line by line.
pub struct Lines<'a> {
    bytes: &'a [u8],
    at: usize,
    line: usize,
}

impl<'a> Lines<'a> {
    /// At the first byte.
    pub fn new(bytes: &'a [u8]) -> Self {
        Self {
            bytes,
            at: 0,
            line: 0,
        }
    }

    /// What is left.
    pub fn rest(&self) -> &'a [u8] {
        &self.bytes[self.at..]
    }

    /// Number of the last line taken.
    pub fn line(&self) -> usize {
        self.line
    }

    /// Passes over `count` bytes (at most to the end).
    pub fn pass(&mut self, count: usize) {
        self.at = (self.at + count).min(self.bytes.len());
    }

    /// The next line without its end (LF or CR LF).
    pub fn next(&mut self) -> Option<Record<'a>> {
        let rest = self.rest();
        if rest.is_empty() {
            return None;
        }
        let end = rest.iter().position(|b| *b == b'\n');
        self.at += end.map_or(rest.len(), |end| end + 1);
        self.line += 1;
        let bytes = &rest[..end.unwrap_or(rest.len())];
        Some(Record {
            bytes: bytes.strip_suffix(b"\r").unwrap_or(bytes),
            line: self.line,
        })
    }
}

/// Whether a line is a marker: `-1` in columns 5 and 6 and nothing else.
pub fn is_marker(bytes: &[u8]) -> bool {
    bytes.starts_with(b"    -1") && bytes[6..].trim_ascii().is_empty()
}

/// The next block; lines between blocks are passed over.
pub fn next<'a>(lines: &mut Lines<'a>) -> Outcome<Option<Block<'a>>> {
    loop {
        match lines.next() {
            None => return Ok(None),
            Some(record) if is_marker(record.bytes) => break,
            Some(_) => {}
        }
    }
    let start = lines.line();
    let kind = lines.next().ok_or_else(|| cut_off(start))?;
    if kind
        .bytes
        .get(6)
        .is_some_and(|b| b.eq_ignore_ascii_case(&b'b'))
    {
        return binary::take(lines, kind).map(Some);
    }
    let set = u32::try_from(kind.integer(0, 6)?).map_err(|_| no_set(kind.line))?;
    let mut records = Vec::new();
    loop {
        let record = lines.next().ok_or_else(|| cut_off(start))?;
        if is_marker(record.bytes) {
            return Ok(Some(Block::Text { set, records }));
        }
        records.push(record);
    }
}

/// The block that began at `line` has no end.
pub fn cut_off(line: usize) -> Problem {
    Problem::new(
        "the file ends inside this data set",
        "copy or export the file again: it was cut off",
    )
    .at_line(line)
}

fn no_set(line: usize) -> Problem {
    Problem::new(
        "no number of a data set",
        "export again: the type line is damaged",
    )
    .at_line(line)
}
