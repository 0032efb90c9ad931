//! The common head of kinds whose rows are single readings: the file, its facts, and the rows that count.

use super::facts::stem;
use super::front::Front;
use super::table::Table;
use crate::ground::files;
use crate::ground::problem::{Outcome, Problem};
use std::fmt::Debug;
use std::path::{Path, PathBuf};

/// What a kind adds: its facts, and how a row is read.
pub trait Kind: Sized {
    /// Its name in the front matter.
    const NAME: &'static str;
    /// Facts that it knows beside those that every kind has.
    const KEYS: &'static [&'static str];
    /// What every row needs: the remedy where no row is usable.
    const NEEDS: &'static str;
    /// One row, SI.
    type Reading: Clone + Debug;

    /// The facts, SI.
    ///
    /// # Errors
    /// A fact that is missing or not of its kind.
    fn of(front: &Front) -> Outcome<Self>;

    /// The rows without an empty cell, in the order of the file.
    ///
    /// # Errors
    /// A column that is missing, or a cell that cannot be.
    fn readings(&self, table: &Table) -> Outcome<Vec<Self::Reading>>;
}

/// A file of the kind whose facts are `F`, SI.
#[derive(Debug, Clone)]
pub struct Test<F: Kind> {
    /// Where it came from.
    pub path: PathBuf,
    /// SHA-256 of the file.
    pub sha256: String,
    /// Its facts.
    pub facts: F,
    /// The readings, in the order of the file.
    pub readings: Vec<F::Reading>,
    /// Rows left out for an empty cell.
    pub left_out: usize,
}

impl<F: Kind> Test<F> {
    /// Reads a file of this kind.
    ///
    /// # Errors
    /// Whatever cannot be understood, with file, line, column and remedy.
    pub fn read(path: &Path) -> Outcome<Self> {
        Self::from_table(Table::read(path)?).map_err(|problem| problem.in_text(path))
    }

    /// Interprets a table that was read already.
    ///
    /// # Errors
    /// As [`Test::read`].
    pub fn from_table(table: Table) -> Outcome<Self> {
        table.front.expect_kind(F::NAME)?;
        table.front.only(F::KEYS)?;
        let facts = F::of(&table.front)?;
        let readings = facts.readings(&table)?;
        if readings.is_empty() {
            let what = format!("holds no usable row ({} left out)", table.rows);
            return Err(Problem::new(what, F::NEEDS).at_line(table.first_line));
        }
        Ok(Self {
            left_out: table.rows - readings.len(),
            sha256: table.sha256,
            path: table.path,
            facts,
            readings,
        })
    }

    /// File name without its ending.
    pub fn stem(&self) -> String {
        stem(&self.path, F::NAME)
    }

    /// The file with its hash: an input.
    pub fn input(&self) -> (PathBuf, String) {
        (self.path.clone(), self.sha256.clone())
    }

    /// Name of the file and its hash: what a result rests on.
    pub fn provenance(&self) -> String {
        let name = files::name(&self.path);
        format!("{} {}", name, self.sha256)
    }
}
