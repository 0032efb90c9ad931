//! Kind `load-cycle`: load and deflection of one axis over several tension/compression cycles.

mod channels;
mod facts;
mod port;

pub(super) use facts::FACTS;
pub use facts::{Facts, LEVER_REL_STD, lever_spread};
pub use port::{Axis, Port};

use super::facts::stem;
use super::table::Table;
use crate::ground::problem::{Outcome, Problem};
use channels::Channels;
pub(crate) use channels::check_time;
use std::path::{Path, PathBuf};

/// One load-cycle file, SI, rows with a missing load or deflection left out (and counted).
#[derive(Debug, Clone)]
pub struct LoadCycle {
    /// Where it came from.
    pub path: PathBuf,
    /// SHA-256 of the file.
    pub sha256: String,
    /// Its facts.
    pub facts: Facts,
    /// Rotational or linear.
    pub port: Port,
    /// Whether the file has no time: rows are counted in its place.
    pub counts_rows: bool,
    /// Time, s; the number of the row where that is counted.
    pub time: Vec<f64>,
    /// Moment N·m or force N.
    pub load: Vec<f64>,
    /// Angle rad or displacement m, first sensor.
    pub deflection: Vec<f64>,
    /// The same from the second sensor; NaN where missing.
    pub second: Option<Vec<f64>>,
    /// Data rows of the file.
    pub rows: usize,
    /// Rows left out because a cell was empty.
    pub left_out: usize,
    /// First row of data in the file (1-based line), to point at rows.
    pub first_line: usize,
    /// What was converted into what, one line per channel.
    pub conversions: Vec<String>,
    /// How the file was written: delimiter and decimal sign.
    pub dialect: String,
}

impl LoadCycle {
    /// Reads a file of kind `load-cycle`.
    pub fn read(path: &Path) -> Outcome<Self> {
        Self::from_table(Table::read(path)?).map_err(|problem| problem.in_text(path))
    }

    /// Interprets a table that was read already.
    pub fn from_table(table: Table) -> Outcome<Self> {
        table.front.expect_kind("load-cycle")?;
        table.front.only(FACTS)?;
        let facts = Facts::of(&table.front)?;
        let ports = Channels::find(&table, &facts)?;
        ports.check_facts(&table.front, &facts)?;
        let cycle = ports.assemble(table, facts)?;
        cycle.check_rows()?;
        Ok(cycle)
    }

    /// Name of the place: `A6`, `A6-tilt`, or `spring` for a linear one.
    pub fn site(&self) -> String {
        match (self.facts.joint, self.facts.axis) {
            (Some(joint), Some(Axis::Tilt)) => format!("A{joint}-tilt"),
            (Some(joint), _) => format!("A{joint}"),
            _ => "spring".to_string(),
        }
    }

    /// File name without its ending.
    pub fn stem(&self) -> String {
        stem(&self.path, "measurement")
    }

    fn check_rows(&self) -> Outcome<()> {
        if self.load.len() >= 4 {
            return Ok(());
        }
        Err(Problem::new(
            format!(
                "holds {} usable row{} ({} of {} left out for an empty cell)",
                self.load.len(),
                if self.load.len() == 1 { "" } else { "s" },
                self.left_out,
                self.rows
            ),
            "a load cycle needs at least 4 rows with time, load and deflection",
        )
        .at_line(self.first_line))
    }
}

impl LoadCycle {
    fn leave_out_missing(&mut self) {
        let keep: Vec<bool> = (0..self.time.len())
            .map(|i| {
                !(self.time[i].is_nan() || self.load[i].is_nan() || self.deflection[i].is_nan())
            })
            .collect();
        self.left_out = keep.iter().filter(|k| !**k).count();
        if self.left_out == 0 {
            return;
        }
        let channels = [
            Some(&mut self.time),
            Some(&mut self.load),
            Some(&mut self.deflection),
            self.second.as_mut(),
        ];
        for channel in channels.into_iter().flatten() {
            let mut kept = keep.iter();
            channel.retain(|_| *kept.next().unwrap_or(&true));
        }
    }

    /// A declared delay of the deflection channel is taken out by reading the load later.
    fn undo_declared_delay(&mut self) {
        if self.facts.sensor_delay == 0.0 {
            return;
        }
        let delay = self.facts.sensor_delay;
        self.load = self
            .time
            .iter()
            .map(|t| interpolate(&self.time, &self.load, t - delay))
            .collect();
        self.conversions
            .push(format!("load shifted by the declared delay of {delay} s"));
    }
}

/// Linear interpolation in ascending `x`, constant beyond its ends.
pub fn interpolate(x: &[f64], y: &[f64], at: f64) -> f64 {
    let i = x.partition_point(|v| *v <= at);
    if i == 0 {
        return y[0];
    }
    if i == x.len() {
        return y[i - 1];
    }
    let (x0, x1) = (x[i - 1], x[i]);
    y[i - 1] + (y[i] - y[i - 1]) * ((at - x0) / (x1 - x0))
}
