//! The time records that drive `ident simulate motion`: forces and joint angles over time.

use crate::ground::files::read_bytes;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::units::{Dimension, Unit, split_name};
use std::path::Path;

/// Columns over time, SI.
#[derive(Debug, Clone, PartialEq)]
pub struct Record {
    time: Vec<f64>,
    columns: Vec<(String, Dimension, Vec<f64>)>,
}

impl Record {
    /// Reads a CSV: `#` lines are skipped, then a header whose names end in units, then numbers.
    ///
    /// # Errors
    /// Missing units, cells that are no numbers, time that does not rise: file, line, column, remedy.
    pub fn read(path: &Path) -> Outcome<Self> {
        let bytes = read_bytes(path)?;
        Self::parse(&bytes).map_err(|problem| problem.in_file(path))
    }

    fn parse(bytes: &[u8]) -> Outcome<Self> {
        let mut reader = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .trim(csv::Trim::All)
            .from_reader(bytes);
        let header = reader.headers().map_err(|error| broken(&error))?.clone();
        let named = header
            .iter()
            .map(|name| split_name(name).ok_or_else(|| no_unit(name)));
        let named: Vec<(String, Unit)> = named.collect::<Outcome<_>>()?;
        let mut columns: Vec<(String, Dimension, Vec<f64>)> = named
            .iter()
            .map(|(stem, unit)| (stem.clone(), unit.dimension, Vec::new()))
            .collect();
        for row in reader.records() {
            let row = row.map_err(|error| broken(&error))?;
            let line = row.position().map_or(0, |at| at.line() as usize);
            for ((cell, (_, unit)), column) in row.iter().zip(&named).zip(&mut columns) {
                column.2.push(unit.factor * number(cell, &column.0, line)?);
            }
        }
        let at = columns
            .iter()
            .position(|(stem, dimension, _)| stem == "time" && *dimension == Dimension::Time);
        let at =
            at.ok_or_else(|| Problem::new("there is no column of time", "name one column time_s"))?;
        let time = columns.remove(at).2;
        rising(&time)?;
        Ok(Self { time, columns })
    }

    /// Duration, s, from zero.
    pub fn end(&self) -> f64 {
        self.time.last().copied().unwrap_or(0.0)
    }

    /// The column `stem` of a dimension, if there is one.
    pub fn column(&self, stem: &str, dimension: Dimension) -> Option<&[f64]> {
        let found = self
            .columns
            .iter()
            .find(|(name, d, _)| name == stem && *d == dimension);
        found.map(|(_, _, values)| values.as_slice())
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

fn no_unit(name: &str) -> Problem {
    Problem::new(
        "the column has no known unit",
        "end every column name in its unit: time_s, fx_N, angle_deg_1",
    )
    .in_column(name)
}

fn number(cell: &str, column: &str, line: usize) -> Outcome<f64> {
    let value = cell.parse::<f64>().ok().filter(|x| x.is_finite());
    value.ok_or_else(|| {
        Problem::new(
            format!("`{cell}` is no finite number"),
            "write one number per cell",
        )
        .at_line(line)
        .in_column(column)
    })
}

fn rising(time: &[f64]) -> Outcome<()> {
    if time.is_empty() {
        return Err(Problem::new(
            "the record has no rows",
            "give at least one row of numbers",
        ));
    }
    match time.windows(2).position(|pair| pair[1] <= pair[0]) {
        Some(row) => Err(Problem::new(
            format!("time does not rise at data row {}", row + 2),
            "sort the rows by time, one row per instant",
        )
        .in_column("time")),
        None => Ok(()),
    }
}

fn broken(error: &csv::Error) -> Problem {
    let problem = Problem::new(
        format!("is no table ({error})"),
        "write one header row and rows of the same length, divided by commas",
    );
    match error.position() {
        Some(at) => problem.at_line(at.line() as usize),
        None => problem,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_and_interpolates() {
        let record = Record::parse(b"# note\ntime_ms, fx_kN\n0, 1\n2, 3\n").unwrap();
        let fx = record.column("fx", Dimension::Force).unwrap();
        assert_eq!(record.at(fx, 0.001), 2000.0);
        assert_eq!((record.at(fx, -1.0), record.at(fx, 1.0)), (1000.0, 3000.0));
    }

    #[test]
    fn refuses_with_the_place() {
        let refuse = |text: &[u8]| Record::parse(text).unwrap_err();
        assert_eq!(refuse(b"time_s,fx\n0,1\n").column.as_deref(), Some("fx"));
        assert_eq!(refuse(b"time_s,fx_N\n0,1\n1,x\n").line, Some(3));
        assert!(refuse(b"time_s,fx_N\n1,1\n1,2\n").what.contains("rise"));
        assert!(refuse(b"fx_N\n1\n").what.contains("time"));
        assert!(refuse(b"time_s,fx_N\n").what.contains("no rows"));
        assert_eq!(refuse(b"time_s,fx_N\n0,1\n1\n").line, Some(3));
    }
}
