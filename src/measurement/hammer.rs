//! Kind `hammer`: impulse-hammer tests, force and acceleration over time.

use super::frf_uff::Given;
use super::front::Front;
use super::hammer_known::Known;
use super::table::{Column, Table};
use crate::ground::problem::{Outcome, Problem};
use crate::ground::units::{DEGREE, Dimension};
use std::ops::Range;
use std::path::Path;

/// A hammer test as measured, in SI.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct HammerRecord {
    /// The robot file named in the front matter.
    pub robot: Option<String>,
    /// Joint angles of the pose, rad.
    pub joint_angles: Option<Vec<f64>>,
    /// Standard deviation of the accelerometer noise, m/s².
    pub accelerometer_noise: Option<f64>,
    /// Relative standard deviation of the stiffnesses of the present simulation.
    pub nominal_rel_std: Option<f64>,
    /// How well the robot's bodies and dampings and the instruments are known.
    pub known: Known,
    /// Time constant, s, of an exponential window already applied to both channels, counted from
    /// the first sample of each record.
    pub exponential_window_s: Option<f64>,
    /// Time between samples, s.
    pub interval_s: f64,
    /// Names of the responses: `x`, `y`, `z`, those that were measured.
    pub outputs: Vec<String>,
    /// The records, in file order.
    pub runs: Vec<HammerRun>,
    /// Frequency responses in place of the records, where the file holds those.
    pub given: Option<Given>,
    /// True when the file says that nobody measured it.
    pub synthetic: bool,
    /// True when the file says `role = "comparison"`: it is taken only when it is named.
    pub comparison: bool,
    /// SHA-256 of the file.
    pub sha256: String,
}

/// One uninterrupted record.
#[derive(Debug, Clone, PartialEq)]
pub struct HammerRun {
    /// Direction of the hit: `x`, `y`, `z`.
    pub direction: String,
    /// Its label in the `hit` column; none: a continuous record, hits are found by trigger.
    pub hit: Option<String>,
    /// Force, N.
    pub force: Vec<f64>,
    /// Acceleration per output, m/s².
    pub responses: Vec<Vec<f64>>,
}

/// Reads a file of kind `hammer`.
pub fn read_hammer(path: &Path) -> Outcome<HammerRecord> {
    from_table(&Table::read(path)?).map_err(|problem| problem.in_text(path))
}

/// The facts of this kind, as they are written.
pub(super) const FACTS: &[&str] = &[
    "joint_angles_deg",
    "accelerometer_noise_m_s2",
    "nominal_stiffness_rel_std",
    "exponential_window_s",
    "mass_rel_std",
    "com_std_m",
    "inertia_rel_std",
    "damping_rel_std",
    "gain_rel_std",
    "condition",
];

fn from_table(table: &Table) -> Outcome<HammerRecord> {
    check_kind(&table.front)?;
    table.front.only(FACTS)?;
    let time = required(table, "time_s", Dimension::Time)?;
    let force = required(table, "force_N", Dimension::Force)?;
    let outputs = outputs(table)?;
    let hits = hits(table)?;
    let spans = spans(table, hits, time);
    let interval_s = interval(table, time, &spans)?;
    let runs = spans
        .iter()
        .map(|span| run(table, hits, force, &outputs, span.clone()))
        .collect::<Outcome<_>>()?;
    Ok(HammerRecord {
        interval_s,
        outputs: outputs.into_iter().map(|(name, _)| name).collect(),
        runs,
        sha256: table.sha256.clone(),
        ..stated(&table.front)?
    })
}

/// What the facts say, without the records.
pub(super) fn stated(front: &Front) -> Outcome<HammerRecord> {
    check_kind(front)?;
    Ok(HammerRecord {
        robot: front.text("robot")?.map(str::to_string),
        joint_angles: joint_angles(front)?,
        accelerometer_noise: front.positive("accelerometer_noise_m_s2")?,
        nominal_rel_std: front.positive("nominal_stiffness_rel_std")?,
        known: Known::read(front)?,
        exponential_window_s: front.positive("exponential_window_s")?,
        synthetic: front.synthetic(),
        comparison: comparison(front)?,
        ..HammerRecord::default()
    })
}

fn check_kind(front: &Front) -> Outcome<()> {
    match front.text("kind")? {
        None | Some("hammer") => Ok(()),
        Some(other) => Err(front.problem(
            "kind",
            format!("is `{other}`, not a hammer test"),
            "give a file of kind `hammer`",
        )),
    }
}

/// The numbers of column `name` (SI), which must measure `dimension`.
fn numbers<'a>(
    table: &'a Table,
    name: &str,
    dimension: Dimension,
) -> Outcome<Option<(&'a Column, &'a [f64])>> {
    let stem = name.split('_').next().unwrap_or(name);
    let Some(column) = table.column(stem) else {
        return Ok(None);
    };
    match column.numbers() {
        Some(values) if column.dimension == Some(dimension) => Ok(Some((column, values))),
        _ => Err(Problem::new(
            format!("does not measure what a hammer test needs in `{stem}`"),
            format!("give this column the unit of `{name}`"),
        )
        .in_column(&column.name)
        .at_line(table.first_line - 1)),
    }
}

fn required<'a>(table: &'a Table, name: &str, dimension: Dimension) -> Outcome<&'a [f64]> {
    let found = numbers(table, name, dimension)?;
    found.map(|(_, values)| values).ok_or_else(|| {
        Problem::new("column is missing", format!("add the column `{name}`"))
            .in_column(name)
            .at_line(table.first_line - 1)
    })
}

type Output<'a> = (String, (&'a Column, &'a [f64]));

/// The measured accelerations: columns `ax`, `ay`, `az` that are not empty throughout.
fn outputs(table: &Table) -> Outcome<Vec<Output<'_>>> {
    let mut outputs = Vec::new();
    for name in ["x", "y", "z"] {
        let column = numbers(table, &format!("a{name}_m_s2"), Dimension::Acceleration)?;
        let measured = column.filter(|(_, values)| values.iter().any(|v| !v.is_nan()));
        outputs.extend(measured.map(|column| (name.to_string(), column)));
    }
    if outputs.is_empty() {
        return Err(Problem::new(
            "no acceleration was measured",
            "add at least one of the columns ax_m_s2, ay_m_s2, az_m_s2",
        ));
    }
    Ok(outputs)
}

/// The hit numbers; none where the file has no such column, or an empty one: continuous records.
fn hits(table: &Table) -> Outcome<Option<&[f64]>> {
    let column = table.column("hit").and_then(Column::numbers);
    let Some(hits) = column.filter(|hits| hits.iter().any(|hit| !hit.is_nan())) else {
        return Ok(None);
    };
    match hits.iter().position(|hit| hit.is_nan()) {
        None => Ok(Some(hits)),
        Some(row) => Err(Problem::new(
            "hit without a number",
            "number every sample of every hit, or leave the whole column empty",
        )
        .at_line(table.line_of(row))
        .in_column("hit")),
    }
}

/// The direction of a row, in lower case.
fn direction(table: &Table, row: usize) -> Option<String> {
    let (codes, words) = table.column("direction")?.words()?;
    Some(words.get(usize::from(*codes.get(row)?))?.to_lowercase())
}

/// Row ranges of the records: a new one where direction or hit changes.
fn spans(table: &Table, hits: Option<&[f64]>, time: &[f64]) -> Vec<Range<usize>> {
    let words = table.column("direction").and_then(Column::words);
    let begins = |i: &usize| {
        words.is_some_and(|(codes, _)| codes[*i] != codes[i - 1])
            || hits.is_some_and(|hits| hits[*i] != hits[i - 1])
    };
    let mut starts: Vec<usize> = (1..time.len()).filter(begins).collect();
    starts.insert(0, 0);
    starts.push(time.len());
    starts.windows(2).map(|w| w[0]..w[1]).collect()
}

/// Mean time step over all records, snapped to a whole sampling rate within 1e-5.
fn interval(table: &Table, time: &[f64], spans: &[Range<usize>]) -> Outcome<f64> {
    let steps: usize = spans.iter().map(|s| s.len().saturating_sub(1)).sum();
    let length = |s: &Range<usize>| time[s.end - 1] - time[s.start];
    let total: f64 = spans.iter().filter(|s| s.len() > 1).map(length).sum();
    if steps < 8 {
        return Err(Problem::new(
            "fewer than 9 samples",
            "give the whole time record of each hit",
        ));
    }
    let interval = snapped(total / steps as f64);
    spans
        .iter()
        .try_for_each(|span| check_steps(table, time, span, interval))?;
    Ok(interval)
}

fn snapped(interval: f64) -> f64 {
    let rate = (1.0 / interval).round();
    let near = (1.0 / interval - rate).abs() <= 1e-5 * rate;
    match near && rate > 0.0 {
        true => 1.0 / rate,
        false => interval,
    }
}

fn check_steps(table: &Table, time: &[f64], span: &Range<usize>, interval: f64) -> Outcome<()> {
    let wrong = |i: &usize| {
        let step = time[*i] - time[i - 1];
        !(step > 0.75 * interval && step < 1.25 * interval)
    };
    let Some(i) = (span.start + 1..span.end).find(wrong) else {
        return Ok(());
    };
    let step = time[i] - time[i - 1];
    let (what, remedy) = if step <= 0.0 {
        (
            "time runs backwards or stands still",
            "sort the samples by time, or start a new hit number",
        )
    } else {
        (
            "time step differs from the others",
            "export an evenly sampled record without gaps",
        )
    };
    let what = format!("{what} (step {step:.3e} s, others {interval:.3e} s)");
    Err(Problem::new(what, remedy)
        .at_line(table.line_of(i))
        .in_column("time_s"))
}

fn run(
    table: &Table,
    hits: Option<&[f64]>,
    force: &[f64],
    outputs: &[Output],
    span: Range<usize>,
) -> Outcome<HammerRun> {
    let whole = |name: &str, column: &[f64]| {
        let part = &column[span.clone()];
        match part.iter().position(|v| v.is_nan()) {
            None => Ok(part.to_vec()),
            Some(i) => Err(Problem::new(
                "missing value inside a time record",
                "export the record without gaps, or leave the whole column empty",
            )
            .at_line(table.line_of(span.start + i))
            .in_column(name)),
        }
    };
    let responses = outputs
        .iter()
        .map(|(_, (column, values))| whole(&column.name, values));
    Ok(HammerRun {
        direction: direction(table, span.start).unwrap_or_else(|| "force".into()),
        hit: hits.map(|hits| hits[span.start].to_string()),
        force: whole("force_N", force)?,
        responses: responses.collect::<Outcome<_>>()?,
    })
}

/// Whether the file is there only to be compared.
fn comparison(front: &Front) -> Outcome<bool> {
    match front.text("role")? {
        None => Ok(false),
        Some("comparison") => Ok(true),
        Some(other) => Err(front.problem(
            "role",
            format!("is `{other}`, which is no role of a hammer test"),
            "write `role = \"comparison\"`, or leave the line out for a test that is tuned to",
        )),
    }
}

/// Joint angles of the pose, rad.
fn joint_angles(front: &Front) -> Outcome<Option<Vec<f64>>> {
    let rad = |degrees: Vec<f64>| degrees.iter().map(|d| d * DEGREE).collect();
    Ok(front.numbers("joint_angles_deg")?.map(rad))
}
