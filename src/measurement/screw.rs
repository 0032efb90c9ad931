//! Kind `screw`: positions that a linear axis was told and those that a scale read, run by run in both
//! directions (source 003, section 3.2; ISO 230-2).

use super::facts::{measured, missing, needed, stem};
use super::front::Front;
use super::table::Table;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::units::Dimension;
use std::path::{Path, PathBuf};

const HEADER: &str = "run,direction,target_mm,actual_mm";
const KEYS: &[&str] = &["pitch_mm", "scale_noise_um", "robot", "axis"];

/// The facts of a screw file, SI.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Facts {
    /// Travel per turn of the screw, m.
    pub pitch: Option<f64>,
    /// Noise of the scale, standard deviation, m.
    pub scale_noise: Option<f64>,
    /// True when the file says that it was simulated.
    pub synthetic: bool,
}

/// One reading, SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reading {
    /// Number of the run as the file gives it.
    pub run: i64,
    /// Whether the target was approached in positive direction.
    pub forward: bool,
    /// Where the axis was told to go, m.
    pub target: f64,
    /// Where it went, m.
    pub actual: f64,
    /// When, s; NaN where it is not told.
    pub time: f64,
    /// Temperature above 0 °C, K; NaN where it is not told.
    pub temperature: f64,
}

/// A screw file, SI.
#[derive(Debug, Clone)]
pub struct ScrewTest {
    /// Where it came from.
    pub path: PathBuf,
    /// SHA-256 of the file.
    pub sha256: String,
    /// Its facts.
    pub facts: Facts,
    /// The readings, in the order of the file.
    pub readings: Vec<Reading>,
    /// Data rows of the file.
    pub rows: usize,
    /// Rows left out because run, direction, target or reading was empty.
    pub left_out: usize,
}

impl ScrewTest {
    /// Reads a file of kind `screw`.
    ///
    /// # Errors
    /// Whatever cannot be understood, with file, line, column and remedy.
    pub fn read(path: &Path) -> Outcome<Self> {
        Self::from_table(Table::read(path)?).map_err(|problem| problem.in_file(path))
    }

    /// Interprets a table that was read already.
    ///
    /// # Errors
    /// As [`ScrewTest::read`].
    pub fn from_table(table: Table) -> Outcome<Self> {
        table.front.expect_kind("screw")?;
        table.front.only(KEYS)?;
        let facts = Facts::of(&table.front)?;
        let readings = readings(&table)?;
        if readings.is_empty() {
            return Err(Problem::new(
                format!("holds no usable row ({} left out)", table.rows),
                "every reading needs run, direction, target and actual position",
            )
            .at_line(table.first_line));
        }
        Ok(Self {
            left_out: table.rows - readings.len(),
            rows: table.rows,
            sha256: table.sha256,
            path: table.path,
            facts,
            readings,
        })
    }

    /// File name without its ending.
    pub fn stem(&self) -> String {
        stem(&self.path, "screw")
    }
}

impl Facts {
    fn of(front: &Front) -> Outcome<Self> {
        Ok(Self {
            pitch: front.positive("pitch_mm")?.map(|mm| mm * 1e-3),
            scale_noise: front.not_negative("scale_noise_um")?.map(|um| um * 1e-6),
            synthetic: front.synthetic(),
        })
    }
}

fn readings(table: &Table) -> Outcome<Vec<Reading>> {
    let run = table.column("run").and_then(|column| column.numbers());
    let run = run.ok_or_else(|| missing(table, "run", HEADER))?;
    let words = table.column("direction").and_then(|column| column.words());
    let (codes, words) = words.ok_or_else(|| missing(table, "direction", HEADER))?;
    let target = needed(table, "target", Dimension::Length, HEADER)?;
    let actual = needed(table, "actual", Dimension::Length, HEADER)?;
    let time = measured(table, "time", Dimension::Time)?;
    let temperature = measured(table, "temperature", Dimension::Temperature)?;
    let or_nan = |column: Option<&[f64]>, row: usize| column.map_or(f64::NAN, |c| c[row]);
    let mut readings = Vec::with_capacity(table.rows);
    for row in 0..table.rows {
        let word = &words[usize::from(codes[row])];
        if word.is_empty() || (run[row] + target[row] + actual[row]).is_nan() {
            continue;
        }
        let place = |problem: Problem| problem.at_line(table.line_of(row));
        readings.push(Reading {
            run: number_of(run[row]).map_err(place)?,
            forward: direction_of(word).map_err(place)?,
            target: target[row],
            actual: actual[row],
            time: or_nan(time, row),
            temperature: or_nan(temperature, row),
        });
    }
    Ok(readings)
}

fn number_of(run: f64) -> Outcome<i64> {
    match run.fract() == 0.0 && run.abs() < 1e9 {
        true => Ok(run as i64),
        false => Err(Problem::new(
            format!("{run} is no number of a run"),
            "count the runs: 1, 2, 3 ...",
        )
        .in_column("run")),
    }
}

fn direction_of(word: &str) -> Outcome<bool> {
    match word.to_ascii_lowercase().as_str() {
        "forward" | "+" => Ok(true),
        "backward" | "-" => Ok(false),
        _ => Err(Problem::new(
            format!("`{word}` is no direction"),
            "write `forward` where the target was approached in positive direction, else `backward`",
        )
        .in_column("direction")),
    }
}
