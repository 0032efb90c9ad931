//! The modes of a survey as tables, text and JSON.

use super::{RobotBeside, Told};
use crate::report::json::{number, numbers};
use crate::report::text::table;
use crate::sheet::number::{ABSENT, fixed, significant, with_interval};
use crate::sheet::table::Table;
use serde_json::{Map, Value, json};
use std::path::Path;

const AXES: [&str; 3] = ["x", "y", "z"];
/// Modes in a row of a matrix that is printed as a table.
const WIDE: usize = 12;

/// The modes.
pub fn modes(told: &Told) -> Table {
    let mut header = vec!["mode", "Hz", "damping %", "in step"];
    if told.robot.is_some() {
        header.extend(["simulated Hz", "damping %", "assurance"]);
    }
    let columns = header.len();
    let mut table = Table::new("Modes of the survey", header).numeric(0..columns);
    let pairs = told.robot.as_ref().map(|robot| robot.beside.pairs());
    for (i, one) in told.found.modes.iter().enumerate() {
        let [hz, damping] = one.mode.half_width;
        let interval = |value: f64, half: f64| match half.is_finite() {
            true => with_interval(value, value - half, value + half),
            false => significant(value, 4),
        };
        let mut row = vec![
            format!("{}", i + 1),
            interval(one.mode.frequency_hz, hz),
            interval(100.0 * one.mode.damping_ratio, 100.0 * damping),
            fixed(one.collinearity, 2),
        ];
        if let (Some(robot), Some(pairs)) = (&told.robot, &pairs) {
            row.extend(paired(robot, pairs[i]));
        }
        table.push(row);
    }
    let note = "In step: modal phase collinearity; 1 where all points pass their ends together.";
    table.noted(note)
}

fn paired(robot: &RobotBeside, pair: Option<(usize, f64)>) -> [String; 3] {
    let Some((s, assurance)) = pair else {
        return [ABSENT, ABSENT, ABSENT].map(String::from);
    };
    let mode = &robot.beside.modes[s];
    [
        fixed(mode.frequency_hz, 2),
        fixed(100.0 * mode.damping_ratio, 2),
        fixed(assurance, 2),
    ]
}

/// A matrix of modal assurance with frequencies at its edges, if it is narrow enough to be read.
pub fn matrix(title: &str, rows: &[f64], columns: &[f64], mac: &[Vec<f64>]) -> Option<Table> {
    if columns.is_empty() || rows.is_empty() || columns.len() > WIDE {
        return None;
    }
    let hz = |f: &f64| format!("{} Hz", fixed(*f, 1));
    let header = std::iter::once(String::new()).chain(columns.iter().map(hz));
    let mut table = Table::new(title, header).numeric(0..columns.len() + 1);
    for (f, row) in rows.iter().zip(mac) {
        let values = row.iter().map(|v| fixed(*v, 2));
        table.push(std::iter::once(hz(f)).chain(values));
    }
    Some(table)
}

/// Frequencies of the measured modes, Hz.
pub fn measured_hz(told: &Told) -> Vec<f64> {
    told.found
        .modes
        .iter()
        .map(|m| m.mode.frequency_hz)
        .collect()
}

/// Frequencies of the simulated modes, Hz.
pub fn simulated_hz(robot: &RobotBeside) -> Vec<f64> {
    robot.beside.modes.iter().map(|m| m.frequency_hz).collect()
}

/// One sentence about the whole.
pub fn sentence(told: &Told) -> String {
    let (points, responses) = (told.measured(), told.survey.dofs.len());
    let references = told.survey.references.join(", ");
    let middle = crate::signal::outliers::median(&told.found.left);
    format!(
        "{} modes at {points} points ({responses} directions, reference {references}); they leave {} % of the power of a response (median).",
        told.found.modes.len(),
        significant(100.0 * middle, 2)
    )
}

/// The account.
pub fn text(told: &Told, written: Option<&Path>) -> String {
    let mut text = sentence(told) + "\n\n" + &table(&modes(told));
    let hz = measured_hz(told);
    let auto = matrix(
        "Modal assurance among the modes of the survey",
        &hz,
        &hz,
        &told.auto,
    );
    let robot = told.robot.as_ref().and_then(|robot| {
        let title = "Modal assurance, survey (rows) beside simulation (columns)";
        matrix(title, &hz, &simulated_hz(robot), &robot.beside.mac)
    });
    for matrix in auto.into_iter().chain(robot) {
        text += &format!("\n{}", table(&matrix));
    }
    written.map_or(text.clone(), |path| {
        text + &format!("\nwritten: {}\n", path.display())
    })
}

/// The result.
pub fn json(told: &Told, written: Option<&Path>) -> Value {
    let shape = |mode: usize| -> Value {
        let all = told.survey.dofs.iter().zip(&told.found.modes[mode].shape);
        let one = |((point, axis), v): (&(usize, usize), &rustfft::num_complex::Complex64)| {
            json!({
                "node": told.survey.geometry.points[*point].label,
                "direction": AXES[*axis],
                "value": [number(v.re), number(v.im)],
            })
        };
        all.map(one).collect()
    };
    let modes = told.found.modes.iter().enumerate().map(|(i, one)| {
        let mut mode = crate::cli::frf::mode(&one.mode);
        mode["phase_collinearity"] = number(one.collinearity);
        mode["shape"] = shape(i);
        mode
    });
    let left = told.survey.record.outputs.iter().zip(&told.found.left);
    let left: Map<String, Value> = left.map(|(name, v)| (name.clone(), number(*v))).collect();
    json!({
        "points": told.survey.geometry.points.len(),
        "references": told.survey.references,
        "modes": modes.collect::<Value>(),
        "auto_mac": told.auto.iter().map(|row| numbers(row)).collect::<Value>(),
        "power_left": left,
        "robot": told.robot.as_ref().map(|robot| beside(told, robot)),
        "remarks": told.remarks(),
        "report": written.map(|path| path.display().to_string()),
    })
}

fn beside(told: &Told, robot: &RobotBeside) -> Value {
    let mode = |m: &crate::experiments::survey::simulated::SimulatedMode| json!({"frequency_Hz": number(m.frequency_hz), "damping_ratio": number(m.damping_ratio)});
    let pairs = robot.beside.pairs().into_iter().enumerate();
    let pairs = pairs.filter_map(|(m, pair)| {
        pair.map(|(s, mac)| json!({"measured": m, "simulated": s, "mac": number(mac)}))
    });
    let points = told
        .survey
        .geometry
        .points
        .iter()
        .zip(&robot.assignment.links);
    let links = points.map(|(point, link)| {
        use crate::experiments::survey::assignment::How;
        let how = |how: How| match how {
            How::Stated => "stated",
            How::Nearest => "nearest",
        };
        json!({"node": point.label, "link": link.map(|l| l.0), "by": link.map(|l| how(l.1))})
    });
    json!({
        "name": robot.loaded.robot.name,
        "modes": robot.beside.modes.iter().map(mode).collect::<Value>(),
        "mac": robot.beside.mac.iter().map(|row| numbers(row)).collect::<Value>(),
        "pairs": pairs.collect::<Value>(),
        "links": links.collect::<Value>(),
    })
}
