//! Kind `hammer`: impulse-hammer tests, force and acceleration over time.

use super::columns::Columns;
use crate::ground::problem::{Outcome, Problem};
use std::path::Path;

/// A hammer test as measured, in SI.
#[derive(Debug, Clone, PartialEq)]
pub struct HammerRecord {
    /// The robot file named in the front matter.
    pub robot: Option<String>,
    /// Joint angles of the pose, rad.
    pub joint_angles: Option<Vec<f64>>,
    /// Standard deviation of the accelerometer noise, m/s².
    pub accelerometer_noise: Option<f64>,
    /// Time constant, s, of an exponential window already applied to both channels, counted from
    /// the first sample of each record.
    pub exponential_window_s: Option<f64>,
    /// Time between samples, s.
    pub interval_s: f64,
    /// Names of the responses: `x`, `y`, `z`, those that were measured.
    pub outputs: Vec<String>,
    /// The records, in file order.
    pub runs: Vec<HammerRun>,
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
    let columns = Columns::read(path)?;
    from_columns(&columns).map_err(|problem| problem.in_file(path))
}

fn from_columns(columns: &Columns) -> Outcome<HammerRecord> {
    let time = required(columns, "time", "time_s")?;
    let force = required(columns, "force", "force_N")?;
    let outputs = outputs(columns)?;
    let spans = spans(columns, time);
    let interval_s = interval(columns, time, &spans)?;
    let runs = spans
        .iter()
        .map(|span| run(columns, force, &outputs, span.clone()))
        .collect::<Outcome<_>>()?;
    Ok(HammerRecord {
        robot: text(columns, "robot"),
        joint_angles: joint_angles(columns)?,
        accelerometer_noise: positive(columns, "accelerometer_noise_m_s2")?,
        exponential_window_s: positive(columns, "exponential_window_s")?,
        interval_s,
        outputs: outputs.into_iter().map(|(name, _)| name).collect(),
        runs,
    })
}

fn required<'a>(columns: &'a Columns, stem: &str, name: &str) -> Outcome<&'a [f64]> {
    columns.numbers(stem).ok_or_else(|| {
        Problem::new("column is missing", format!("add the column `{name}`")).in_column(name)
    })
}

/// The measured accelerations: columns `ax`, `ay`, `az` that are not empty throughout.
fn outputs(columns: &Columns) -> Outcome<Vec<(String, &[f64])>> {
    let measured = ["x", "y", "z"].into_iter().filter_map(|name| {
        let column = columns.numbers(&format!("a{name}"))?;
        let any = column.iter().any(|v| !v.is_nan());
        any.then(|| (name.to_string(), column))
    });
    let outputs: Vec<_> = measured.collect();
    if outputs.is_empty() {
        return Err(Problem::new(
            "no acceleration was measured",
            "add at least one of the columns ax_m_s2, ay_m_s2, az_m_s2",
        ));
    }
    Ok(outputs)
}

/// Row ranges of the records: a new one where direction or hit changes, or time starts again.
fn spans(columns: &Columns, time: &[f64]) -> Vec<std::ops::Range<usize>> {
    let differs = |words: Option<&[String]>, i: usize| words.is_some_and(|w| w[i] != w[i - 1]);
    let begins =
        |i: usize| differs(columns.words("direction"), i) || differs(columns.words("hit"), i);
    let mut starts: Vec<usize> = (1..time.len()).filter(|i| begins(*i)).collect();
    starts.insert(0, 0);
    starts.push(time.len());
    starts.windows(2).map(|w| w[0]..w[1]).collect()
}

/// Mean time step over all records, snapped to a whole sampling rate within 1e-5.
fn interval(columns: &Columns, time: &[f64], spans: &[std::ops::Range<usize>]) -> Outcome<f64> {
    let steps: usize = spans.iter().map(|s| s.len().saturating_sub(1)).sum();
    let length = |s: &std::ops::Range<usize>| time[s.end - 1] - time[s.start];
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
        .try_for_each(|span| check_steps(columns, time, span, interval))?;
    Ok(interval)
}

fn snapped(interval: f64) -> f64 {
    let rate = (1.0 / interval).round();
    let near = (1.0 / interval - rate).abs() <= 1e-5 * rate;
    if near && rate > 0.0 {
        1.0 / rate
    } else {
        interval
    }
}

fn check_steps(
    columns: &Columns,
    time: &[f64],
    span: &std::ops::Range<usize>,
    interval: f64,
) -> Outcome<()> {
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
        .at_line(columns.lines[i])
        .in_column("time_s"))
}

fn run(
    columns: &Columns,
    force: &[f64],
    outputs: &[(String, &[f64])],
    span: std::ops::Range<usize>,
) -> Outcome<HammerRun> {
    let word = |name: &str| columns.words(name).map(|words| words[span.start].clone());
    let whole = |name: &str, column: &[f64]| {
        let part = &column[span.clone()];
        match part.iter().position(|v| v.is_nan()) {
            None => Ok(part.to_vec()),
            Some(i) => Err(Problem::new(
                "missing value inside a time record",
                "export the record without gaps, or leave the whole column empty",
            )
            .at_line(columns.lines[span.start + i])
            .in_column(name)),
        }
    };
    let responses = outputs
        .iter()
        .map(|(name, column)| whole(&format!("a{name}_m_s2"), column));
    Ok(HammerRun {
        direction: word("direction").map_or_else(|| "force".into(), |d| d.to_lowercase()),
        hit: word("hit"),
        force: whole("force_N", force)?,
        responses: responses.collect::<Outcome<_>>()?,
    })
}

fn text(columns: &Columns, key: &str) -> Option<String> {
    Some(columns.front.get(key)?.as_str()?.to_string())
}

fn number(value: &toml::Value) -> Option<f64> {
    value
        .as_float()
        .or_else(|| Some(value.as_integer()? as f64))
}

fn positive(columns: &Columns, key: &str) -> Outcome<Option<f64>> {
    let Some(value) = columns.front.get(key) else {
        return Ok(None);
    };
    match number(value) {
        Some(v) if v > 0.0 && v.is_finite() => Ok(Some(v)),
        _ => Err(Problem::new("is not a positive number", "write a number above 0").in_column(key)),
    }
}

fn joint_angles(columns: &Columns) -> Outcome<Option<Vec<f64>>> {
    let key = "joint_angles_deg";
    let Some(value) = columns.front.get(key) else {
        return Ok(None);
    };
    let degrees = value.as_array().map(|row| row.iter().map(number).collect());
    let degrees: Option<Option<Vec<f64>>> = degrees;
    let degrees = degrees.flatten().ok_or_else(|| {
        Problem::new("is not a list of numbers", "write [q1, q2, q3, q4, q5, q6]").in_column(key)
    })?;
    let radians = |d: f64| d * crate::ground::units::DEGREE;
    Ok(Some(degrees.into_iter().map(radians).collect()))
}
