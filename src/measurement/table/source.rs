//! The bytes of a file, hashed as they pass, and its head: front matter and header row.

use crate::ground::files::unreadable;
use crate::ground::problem::{Outcome, Problem};
use crate::measurement::front::Front;
use sha2::{Digest, Sha256};
use std::io::{BufRead, Read};

/// A reader that hashes what passes through it and refuses endless lines.
pub(super) struct Hashing<R> {
    source: R,
    digest: Sha256,
    since_line_end: usize,
}

impl<R: Read> Hashing<R> {
    pub(super) fn new(source: R) -> Self {
        Self {
            source,
            digest: Sha256::new(),
            since_line_end: 0,
        }
    }

    /// The digest of all that was read; the body is read to its end before.
    pub(super) fn finish(self) -> String {
        let bytes = self.digest.finalize();
        bytes.iter().map(|b| format!("{b:02x}")).collect()
    }
}

impl<R: Read> Read for Hashing<R> {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        let n = self.source.read(buffer)?;
        self.digest.update(&buffer[..n]);
        self.since_line_end = match buffer[..n].iter().rposition(|b| *b == b'\n') {
            Some(at) => n - at - 1,
            None => self.since_line_end + n,
        };
        if self.since_line_end > LONGEST_LINE {
            return Err(std::io::Error::other("line longer than any row of a table"));
        }
        Ok(n)
    }
}

/// Longest line accepted: longer ones are no table, and must not fill the memory.
const LONGEST_LINE: usize = 1 << 20;

fn read_line(reader: &mut impl BufRead, line: usize) -> Outcome<Option<String>> {
    let mut bytes = Vec::new();
    let n = reader
        .read_until(b'\n', &mut bytes)
        .map_err(|e| unreadable(&e).at_line(line))?;
    if n == 0 {
        return Ok(None);
    }
    if line == 1 {
        reject_binary(&bytes)?;
        if bytes.starts_with(b"\xEF\xBB\xBF") {
            bytes.drain(..3);
        }
    }
    let not_text =
        || Problem::new("is not UTF-8 text", "export the table as CSV in UTF-8").at_line(line);
    if bytes.contains(&0) {
        return Err(not_text());
    }
    let text = String::from_utf8(bytes).map_err(|_| not_text())?;
    Ok(Some(text.trim_end_matches(['\n', '\r']).to_string()))
}

fn reject_binary(start: &[u8]) -> Outcome<()> {
    if start.starts_with(b"\xFF\xFE") || start.starts_with(b"\xFE\xFF") {
        return Err(Problem::new("is UTF-16 text", "save it as UTF-8").at_line(1));
    }
    if start.starts_with(b"PK\x03\x04") {
        return Err(Problem::new(
            "is a spreadsheet or archive, not a CSV table",
            "export the sheet as CSV (UTF-8)",
        )
        .at_line(1));
    }
    Ok(())
}

pub(super) fn read_head(reader: &mut impl BufRead) -> Outcome<(Front, String, usize)> {
    let mut front = String::new();
    let mut line = 0;
    loop {
        line += 1;
        let Some(text) = read_line(reader, line)? else {
            let what = if line == 1 {
                "is empty"
            } else {
                "has no header row"
            };
            return Err(Problem::new(
                what,
                "write the facts in `#` lines, then one header row such as `time_s,force_N,displacement_mm`, then numbers",
            )
            .at_line(line));
        };
        match text.strip_prefix('#') {
            Some(rest) => front.push_str(rest.strip_prefix(' ').unwrap_or(rest)),
            None if text.trim().is_empty() => {}
            None => return Ok((Front::parse(front)?, text, line)),
        }
        front.push('\n');
    }
}
