//! Arrays for a Galil motion card (source 003 has a DMC-1842), which has no pitch table of its own: its
//! program looks the correction up and adds it to the command. Its numbers carry four decimals, so positions
//! are in mm and corrections in µm; one assignment stands on a line, and no name is one of its instructions
//! (two letters).

use super::{Exporter, PitchTable, Row, strange};
use crate::ground::problem::Outcome;
use std::fmt::Write;

pub(super) const EXPORTER: Exporter = Exporter {
    name: "galil",
    ending: ".dmc",
    about: "arrays for a Galil card: PTX targets in mm, PTF and PTB corrections in µm, PTN their number",
    write,
    read,
};

/// Targets, corrections forward and backward.
const ARRAYS: [&str; 3] = ["PTX", "PTF", "PTB"];

fn write(table: &PitchTable) -> Outcome<String> {
    let mut text = String::from("#PITCH\n");
    for remark in table.remarks() {
        let _ = writeln!(text, "REM {remark}");
    }
    let n = table.rows.len();
    let _ = writeln!(text, "PTN={n}");
    for name in ARRAYS {
        let _ = writeln!(text, "DM {name}[{n}]");
    }
    for (i, row) in table.rows.iter().enumerate() {
        let values = [row.target_mm, row.forward_um, row.backward_um];
        for (name, value) in ARRAYS.iter().zip(values) {
            let _ = writeln!(text, "{name}[{i}]={value:.4}");
        }
    }
    text.push_str("EN\n");
    Ok(text)
}

fn read(text: &str) -> Outcome<PitchTable> {
    let mut table = PitchTable::default();
    let frame = |line: &str| {
        line.is_empty()
            || ["#PITCH", "REM ", "PTN=", "DM ", "EN"]
                .iter()
                .any(|s| line.starts_with(s))
    };
    let lines = text.lines().map(str::trim).enumerate();
    for (i, line) in lines.filter(|(_, line)| !frame(line)) {
        let wrong = || strange(i, "`PTX[0]=0.0`, `PTF[0]=1.0`, `PTB[0]=2.0`, row by row");
        let (array, row, value) = assignment(line).ok_or_else(wrong)?;
        if array == 0 && row == table.rows.len() {
            table.rows.push(Row::default());
        }
        let row = table.rows.get_mut(row).ok_or_else(wrong)?;
        match array {
            0 => row.target_mm = value,
            1 => row.forward_um = value,
            _ => row.backward_um = value,
        }
    }
    Ok(table)
}

/// Number of the array, of its element, and the value.
fn assignment(line: &str) -> Option<(usize, usize, f64)> {
    let (place, value) = line.split_once('=')?;
    let (name, element) = place.strip_suffix(']')?.split_once('[')?;
    let array = ARRAYS.iter().position(|known| *known == name)?;
    let value: f64 = value.trim().parse().ok()?;
    Some((array, element.parse().ok()?, value)).filter(|found| found.2.is_finite())
}
