//! The time records that drive `ident simulate motion`: forces and joint angles over time.

use crate::ground::problem::{Outcome, Problem};
use crate::ground::units::Dimension;
use crate::measurement::table::Table;
use std::path::Path;

/// Columns over time, SI.
#[derive(Debug, Clone)]
pub struct Record {
    table: Table,
    time: Vec<f64>,
}

impl Record {
    /// Reads a measurement file with a column of time.
    ///
    /// # Errors
    /// Whatever the general reader refuses; no time, an empty cell, time that does not rise.
    pub fn read(path: &Path) -> Outcome<Self> {
        Self::of(Table::read(path)?).map_err(|problem| problem.in_text(path))
    }

    fn of(table: Table) -> Outcome<Self> {
        if let Some(column) = table.columns.iter().find(|column| column.missing > 0) {
            let what = format!("{} cells are empty", column.missing);
            let remedy = "a record that drives a simulation needs a number in every row";
            return Err(Problem::new(what, remedy).in_column(&column.name));
        }
        let time = find(&table, "time", Dimension::Time);
        let time = time
            .ok_or_else(|| Problem::new("there is no column of time", "name one column time_s"))?;
        rising(time, table.first_line)?;
        Ok(Self {
            time: time.to_vec(),
            table,
        })
    }

    /// Path and hash, as results list their inputs.
    pub fn input(&self) -> (String, String) {
        (
            self.table.path.display().to_string(),
            self.table.sha256.clone(),
        )
    }

    /// Time of the last row, s.
    pub fn end(&self) -> f64 {
        self.time.last().copied().unwrap_or(0.0)
    }

    /// The column `stem` of a dimension, if there is one.
    pub fn column(&self, stem: &str, dimension: Dimension) -> Option<&[f64]> {
        find(&self.table, stem, dimension)
    }

    /// A column at time `t`, linear between rows, constant beyond the ends.
    pub fn at(&self, column: &[f64], t: f64) -> f64 {
        let after = self.time.partition_point(|time| *time <= t);
        let Some(before) = after.checked_sub(1) else {
            return column.first().copied().unwrap_or(0.0);
        };
        let (Some(t0), Some(x0)) = (self.time.get(before), column.get(before)) else {
            return 0.0;
        };
        match (self.time.get(after), column.get(after)) {
            (Some(t1), Some(x1)) => x0 + (x1 - x0) * (t - t0) / (t1 - t0),
            _ => *x0,
        }
    }
}

fn find<'a>(table: &'a Table, stem: &str, dimension: Dimension) -> Option<&'a [f64]> {
    table
        .column(stem)
        .filter(|column| column.dimension == Some(dimension))?
        .numbers()
}

fn rising(time: &[f64], first_line: usize) -> Outcome<()> {
    if time.is_empty() {
        return Err(Problem::new(
            "the record has no rows",
            "give at least one row of numbers",
        ));
    }
    match time.windows(2).position(|pair| pair[1] <= pair[0]) {
        Some(row) => {
            let problem = Problem::new(
                "time does not rise",
                "sort the rows by time, one row per instant",
            );
            Err(problem.at_line(first_line + row + 1).in_column("time"))
        }
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Outcome<Record> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("force.csv");
        std::fs::write(&path, text).unwrap();
        Record::read(&path)
    }

    #[test]
    fn reads_and_interpolates() {
        let record = read("time_ms,fx_kN\n0,1\n2,3\n").unwrap();
        let fx = record.column("fx", Dimension::Force).unwrap();
        assert_eq!(record.at(fx, 0.001), 2000.0);
        assert_eq!((record.at(fx, -1.0), record.at(fx, 1.0)), (1000.0, 3000.0));
    }

    #[test]
    fn refuses_with_the_place() {
        assert_eq!(read("time_s,fx_N\n1,1\n1,2\n").unwrap_err().line, Some(3));
        assert!(read("fx_N\n1\n").unwrap_err().what.contains("time"));
        assert!(
            read("time_s,fx_N\n0,\n")
                .unwrap_err()
                .what
                .contains("empty")
        );
    }
}
