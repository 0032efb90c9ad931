//! Arrays for a Galil motion card (source 003 has a DMC-1842): the program of the card looks the
//! correction up. Its numbers carry four decimals, so positions are in mm and corrections in µm.

use super::{Exporter, PitchTable, Row, strange};
use crate::ground::problem::Outcome;
use std::fmt::Write;

pub(super) const EXPORTER: Exporter = Exporter {
    name: "galil",
    ending: ".dmc",
    about: "arrays for a Galil card: TX targets in mm, TF and TB corrections in µm, TN their number",
    write,
    read,
};

fn write(table: &PitchTable) -> Outcome<String> {
    let mut text = String::from("#PITCH\n");
    for remark in table.remarks() {
        let _ = writeln!(text, "REM {remark}");
    }
    let n = table.rows.len();
    let _ = writeln!(text, "TN={n}\nDM TX[{n}],TF[{n}],TB[{n}]");
    for (i, row) in table.rows.iter().enumerate() {
        let _ = writeln!(
            text,
            "TX[{i}]={:.4};TF[{i}]={:.4};TB[{i}]={:.4}",
            row.target_mm, row.forward_um, row.backward_um
        );
    }
    text.push_str("EN\n");
    Ok(text)
}

fn read(text: &str) -> Outcome<PitchTable> {
    let mut table = PitchTable::default();
    let frame = |line: &str| {
        line.is_empty()
            || ["#PITCH", "REM ", "TN=", "DM ", "EN"]
                .iter()
                .any(|s| line.starts_with(s))
    };
    for (i, line) in text
        .lines()
        .enumerate()
        .filter(|(_, line)| !frame(line.trim()))
    {
        table
            .rows
            .push(row(line).ok_or_else(|| strange(i, "`TX[0]=0.0;TF[0]=1.0;TB[0]=2.0`"))?);
    }
    Ok(table)
}

fn row(line: &str) -> Option<Row> {
    let value = |name: &str| {
        let cell = line.split(';').find(|cell| cell.trim().starts_with(name))?;
        cell.split_once('=')?.1.trim().parse().ok()
    };
    Some(Row {
        target_mm: value("TX[")?,
        forward_um: value("TF[")?,
        backward_um: value("TB[")?,
    })
}
