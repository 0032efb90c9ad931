//! Kind `screw`: positions that a linear axis was told and those that a scale read, run by run in both
//! directions (source 003, section 3.2; ISO 230-2).

use super::facts::{measured, missing, needed};
use super::front::Front;
use super::table::Table;
use super::test::{Kind, Test};
use crate::ground::problem::{Outcome, Problem};
use crate::ground::units::Dimension;

const HEADER: &str = "run,direction,target_mm,actual_mm";

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
pub type ScrewTest = Test<Facts>;

impl Kind for Facts {
    const NAME: &'static str = "screw";
    const KEYS: &'static [&'static str] = &["pitch_mm", "scale_noise_um", "robot", "axis"];
    const NEEDS: &'static str = "every reading needs run, direction, target and actual position";
    type Reading = Reading;

    fn of(front: &Front) -> Outcome<Self> {
        Ok(Self {
            pitch: front.positive("pitch_mm")?.map(|mm| mm * 1e-3),
            scale_noise: front.not_negative("scale_noise_um")?.map(|um| um * 1e-6),
            synthetic: front.synthetic(),
        })
    }

    fn readings(&self, table: &Table) -> Outcome<Vec<Reading>> {
        readings(table)
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
