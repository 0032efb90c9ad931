//! The general reader: CSV with front matter, units in the column names, into SI columns.
//!
//! One pass, row by row; memory is the numbers and one line. Delimiter (`,` `;` tab) and decimal
//! comma are recognised from the header and the cells.

mod body;
mod cell;
mod column;
mod layout;
mod source;

pub use column::{Cells, Column};

use super::foreign::{Reading, Sidecar, translated};
use super::front::Front;
use crate::ground::files;
use crate::ground::problem::Outcome;
use body::Body;
use layout::Layout;
use source::{Hashing, read_head};
use std::io::{BufReader, Read};
use std::path::{Path, PathBuf};

/// A measurement file as read: facts and columns.
#[derive(Debug, Clone)]
pub struct Table {
    /// Where it came from.
    pub path: PathBuf,
    /// SHA-256 of the file.
    pub sha256: String,
    /// Its facts.
    pub front: Front,
    /// Its columns, in file order.
    pub columns: Vec<Column>,
    /// Number of data rows.
    pub rows: usize,
    /// Delimiter found.
    pub delimiter: char,
    /// Whether numbers use a decimal comma.
    pub decimal_comma: bool,
    /// 1-based line of the first data row.
    pub first_line: usize,
    /// Rows that do not stand on the line after the row before, and their 1-based lines.
    jumps: Vec<(usize, usize)>,
}

impl Table {
    /// Reads a file: its own form, or that of another program, with the facts that stand beside it.
    ///
    /// # Errors
    /// Whatever cannot be understood, with file, line, column and remedy.
    pub fn read(path: &Path) -> Outcome<Self> {
        let sidecar = Sidecar::beside(path)?;
        let foreign = translated(path, &sidecar).map_err(|p| p.in_file(path))?;
        let mut table = match foreign {
            Some(reading) => Self::of_foreign(path, &reading)?,
            None => Self::native(path)?,
        };
        table.front.inherit(sidecar);
        Ok(table)
    }

    /// A translated file; lines are those of the raw one.
    fn of_foreign(path: &Path, reading: &Reading) -> Outcome<Self> {
        let raw = |line: usize| match line > reading.shift {
            true => line - reading.shift - 1 + reading.first_line,
            false if line == reading.shift => reading.skipped + 1,
            false => line,
        };
        let text = reading.text.as_bytes();
        let read = Self::from_reader(path, text, text.len() as u64);
        let mut table = read.map_err(|mut problem| {
            problem.line = problem.line.map(raw);
            problem
        })?;
        table.sha256.clone_from(&reading.sha256);
        table.first_line = raw(table.first_line);
        table.jumps.iter_mut().for_each(|jump| jump.1 = raw(jump.1));
        Ok(table)
    }

    fn native(path: &Path) -> Outcome<Self> {
        let (file, bytes) = files::open(path)?;
        Self::from_reader(path, file, bytes)
    }

    /// Reads a table from any source; `path` names it, `bytes` (any good guess) is its length.
    pub fn from_reader(path: &Path, source: impl Read, bytes: u64) -> Outcome<Self> {
        Self::parse(path, source, bytes).map_err(|problem| problem.in_text(path))
    }

    /// The column with this stem, if present.
    pub fn column(&self, stem: &str) -> Option<&Column> {
        self.columns.iter().find(|column| column.stem == stem)
    }

    /// 1-based line on which a data row stands.
    pub fn line_of(&self, row: usize) -> usize {
        match self.jumps.partition_point(|jump| jump.0 <= row) {
            0 => self.first_line + row,
            n => self.jumps[n - 1].1 + row - self.jumps[n - 1].0,
        }
    }

    fn parse(path: &Path, source: impl Read, bytes: u64) -> Outcome<Self> {
        let mut reader = BufReader::with_capacity(1 << 18, Hashing::new(source));
        let (front, header, header_line) = read_head(&mut reader)?;
        let layout = Layout::of_header(&header, header_line)?;
        let mut body = Body::new(layout, bytes as usize, header.len());
        body.read(&mut reader)?;
        let digest = reader.into_inner().finish();
        Ok(Self {
            path: path.to_path_buf(),
            sha256: digest,
            front,
            rows: body.rows,
            delimiter: body.layout.delimiter as char,
            decimal_comma: body.decimal_comma == Some(true),
            first_line: header_line + 1,
            columns: body.columns,
            jumps: body.jumps,
        })
    }
}
