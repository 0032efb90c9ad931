//! Kind `milling-force`: records of a dynamometer while straight cuts are milled.

mod air;
mod facts;

pub(super) use facts::KEYS;
pub use facts::{CutFacts, CutSide, Facts, Nominal};

use super::table::{Column, Table};
use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::V3;
use crate::ground::units::Dimension;
use std::path::{Path, PathBuf};

/// The record of one cut.
#[derive(Debug, Clone, Default)]
pub struct Record {
    /// Time, s; as in the file.
    pub time: Vec<f64>,
    /// Force on the tool, N, whatever side the file wrote: x along the feed, z the spindle axis.
    pub force: Vec<V3>,
    /// Data row of the file that each came from.
    pub row: Vec<usize>,
    /// Time of the first row of the cut in the file, s: of one that is not in here where the tool was still in air.
    pub begins_s: f64,
}

/// A file of this kind.
#[derive(Debug, Clone)]
pub struct MillingForce {
    /// Where it came from.
    pub path: PathBuf,
    /// SHA-256 of the file.
    pub sha256: String,
    /// Its facts.
    pub facts: Facts,
    /// One record for each of [`Facts::cuts`].
    pub records: Vec<Record>,
    /// Rows left out because a cell was empty.
    pub left_out: usize,
    /// Rows left out because the tool was not in the stock as far as it went later, or before.
    pub in_air: usize,
}

/// Where the rows are that [`MillingForce::in_air`] counts.
pub const IN_AIR: &str = "in which the tool is in air, or on its way into the stock or out of it";

/// Rows of a cut below which nothing can be told.
pub const FEWEST_ROWS: usize = 32;

impl MillingForce {
    /// Reads a file of kind `milling-force`.
    ///
    /// # Errors
    /// What is missing or wrong, with line, column and remedy.
    pub fn read(path: &Path) -> Outcome<Self> {
        Self::from_table(Table::read(path)?).map_err(|problem| problem.in_text(path))
    }

    /// Interprets a table that was read already.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn from_table(table: Table) -> Outcome<Self> {
        table.front.expect_kind("milling-force")?;
        let facts = Facts::of(&table.front)?;
        let (mut records, left_out) = records(&table, &facts)?;
        let in_air = leave_air(&mut records, &facts);
        Ok(Self {
            facts,
            records,
            left_out,
            in_air,
            path: table.path,
            sha256: table.sha256,
        })
    }

    /// Name of the file without its ending.
    pub fn stem(&self) -> String {
        let stem = self.path.file_stem().unwrap_or_default();
        stem.to_string_lossy().to_string()
    }
}

fn numbers<'a>(table: &'a Table, stem: &str, dimension: Option<Dimension>) -> Outcome<&'a [f64]> {
    let header = table.first_line - 1;
    let missing = || {
        Problem::new(
            format!("has no column `{stem}`"),
            "write the columns `cut,time_s,fx_N,fy_N,fz_N`",
        )
        .at_line(header)
    };
    let column: &Column = table.column(stem).ok_or_else(missing)?;
    match dimension {
        Some(wanted) if column.dimension != Some(wanted) => Err(column.misplaced(wanted, header)),
        _ => column.numbers().ok_or_else(missing),
    }
}

fn records(table: &Table, facts: &Facts) -> Outcome<(Vec<Record>, usize)> {
    // The program of a dynamometer writes one cut to a file, and no column for that.
    let alone = vec![1.0; table.rows];
    let cut = match (table.column("cut"), facts.cuts.len()) {
        (None, 1) => &alone[..],
        _ => numbers(table, "cut", None)?,
    };
    let time = numbers(table, "time", Some(Dimension::Time))?;
    let mut force = Vec::new();
    for stem in ["fx", "fy", "fz"] {
        force.push(numbers(table, stem, Some(Dimension::Force))?);
    }
    let sign = if facts.on_tool { 1.0 } else { -1.0 };
    let mut records = vec![Record::default(); facts.cuts.len()];
    let (mut left_out, mut last) = (0, f64::NEG_INFINITY);
    for row in 0..table.rows {
        let f = [force[0][row], force[1][row], force[2][row]].map(|v| sign * v);
        if f.iter().chain([&time[row], &cut[row]]).any(|v| v.is_nan()) {
            left_out += 1;
            continue;
        }
        let record = &mut records[place(table, cut[row], row, facts.cuts.len())?];
        if time[row] <= last {
            return Err(standing(table, row));
        }
        last = time[row];
        if record.time.is_empty() {
            record.begins_s = last;
        }
        record.time.push(time[row]);
        record.force.push(f);
        record.row.push(row);
    }
    long_enough(&records)?;
    Ok((records, left_out))
}

/// Rows in air, and on the way in and out, leave the records; how many.
fn leave_air(records: &mut [Record], facts: &Facts) -> usize {
    let mut left = 0;
    for (record, cut) in records.iter_mut().zip(&facts.cuts) {
        let kept = air::in_stock(record, cut, 0.5 * facts.diameter_m);
        left += record.time.len() - kept.len();
        *record = Record {
            time: record.time[kept.clone()].to_vec(),
            force: record.force[kept.clone()].to_vec(),
            row: record.row[kept].to_vec(),
            begins_s: record.begins_s,
        };
    }
    left
}

fn place(table: &Table, cut: f64, row: usize, cuts: usize) -> Outcome<usize> {
    if cut.fract() == 0.0 && cut >= 1.0 && cut <= cuts as f64 {
        return Ok(cut as usize - 1);
    }
    Err(Problem::new(
        format!("is {cut}, but `cuts` lists {cuts}"),
        "number the cuts from 1 in the order of `cuts` in the front matter",
    )
    .in_column("cut")
    .at_line(table.line_of(row)))
}

fn standing(table: &Table, row: usize) -> Problem {
    Problem::new(
        "time does not move forward",
        "let time run on over all cuts, with as many digits as the sampling needs",
    )
    .in_column("time_s")
    .at_line(table.line_of(row))
}

fn long_enough(records: &[Record]) -> Outcome<()> {
    match records.iter().position(|r| r.time.len() < FEWEST_ROWS) {
        None => Ok(()),
        Some(i) => Err(Problem::new(
            format!(
                "cut {} has {} rows; fewer than {FEWEST_ROWS} tell nothing",
                i + 1,
                records[i].time.len()
            ),
            "record each cut over several revolutions, or take it out of `cuts`",
        )
        .in_column("cut")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRONT: &str = "# kind = \"milling-force\"\n# diameter_mm = 16.0\n# teeth = 2\n# helix_deg = 30\n# cuts = [{ spindle_rpm = 6000, feed_mm_min = 1200, depth_mm = 2, width_mm = 16, cut = \"slot\" }]\n";

    fn read(front: &str, rows: &str) -> Outcome<MillingForce> {
        let text = format!("{front}cut,time_s,fx_N,fy_N,fz_N\n{rows}");
        let bytes = text.len() as u64;
        let table = Table::from_reader("a.csv".as_ref(), text.as_bytes(), bytes)?;
        MillingForce::from_table(table)
    }

    fn rows(count: usize) -> String {
        (0..count)
            .map(|i| format!("1,{},1.5,-2,3\n", 1e-4 * i as f64))
            .collect()
    }

    #[test]
    fn a_force_on_the_workpiece_is_turned_to_the_tool() {
        let file = read(FRONT, &rows(40)).unwrap();
        assert_eq!(file.records[0].force[3], [-1.5, 2.0, -3.0]);
        assert!((file.facts.cuts[0].spindle_rad_s - 628.318_530_7).abs() < 1e-6);
        let on_tool = format!("{FRONT}# force_on = \"tool\"\n");
        assert_eq!(
            read(&on_tool, &rows(40)).unwrap().records[0].force[3][0],
            1.5
        );
    }

    #[test]
    fn what_is_wrong_is_named_with_its_line() {
        let line = |front: &str, rows: &str| read(front, rows).unwrap_err().line;
        assert_eq!(
            line(&FRONT.replace("helix_deg", "helix_dge"), &rows(40)),
            Some(4)
        );
        assert_eq!(
            line(&FRONT.replace("\"slot\"", "\"left\""), &rows(40)),
            Some(5)
        );
        assert_eq!(
            line(&FRONT.replace("depth_mm = 2", "depth = 2"), &rows(40)),
            Some(5)
        );
        assert_eq!(
            line(&FRONT.replace("teeth = 2", "teeth = 2.5"), &rows(40)),
            Some(3)
        );
        let other = rows(40).replacen("1,0.0003", "2,0.0003", 1);
        assert_eq!(line(FRONT, &other), Some(10));
        assert!(read(FRONT, &rows(5)).is_err());
        let empty = rows(40).replacen("1.5", "", 1);
        assert_eq!(read(FRONT, &empty).unwrap().left_out, 1);
    }
}
