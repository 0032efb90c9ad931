//! Siemens SINUMERIK, error of the measuring system (EEC, also LEC): one table for both directions, whose
//! values change the reading of the encoder. "A positive compensation value causes the corresponding
//! machine axis to move in the negative direction" (SINUMERIK 808D function manual, 2017): the values are
//! the error in mm, the mean of both directions; backlash goes into MD32450.

use super::resample::{Even, evenly, is_frame, variable};
use super::{Exporter, PitchTable, strange};
use crate::ground::problem::Outcome;
use std::fmt::Write;

pub(super) const EXPORTER: Exporter = Exporter {
    name: "siemens-eec",
    ending: ".spf",
    about: "SINUMERIK $AA_ENC_COMP: mean of both directions, at equal distances, mm, sign of the error",
    write,
    read,
};

fn write(table: &PitchTable) -> Outcome<String> {
    let even = Even::of(table)?;
    let gap = even
        .rows
        .iter()
        .map(|row| row.forward_um - row.backward_um)
        .sum::<f64>()
        / even.rows.len() as f64;
    let mut text = String::from("%_N_AX_EEC_INI\nCHANDATA(1)\n");
    for remark in table.remarks() {
        let _ = writeln!(text, "; {remark}");
    }
    text.push_str("; axis AX1: replace its name; values in mm\n");
    let _ = writeln!(
        text,
        "; the directions differ by {:.6} mm: MD32450 BACKLASH",
        gap * 1e-3
    );
    for (i, row) in even.rows.iter().enumerate() {
        let error = -0.5e-3 * (row.forward_um + row.backward_um);
        let _ = writeln!(text, "$AA_ENC_COMP[0,{i},AX1]={error:.6}");
    }
    let _ = writeln!(
        text,
        "$AA_ENC_COMP_STEP[0,AX1]={}\n$AA_ENC_COMP_MIN[0,AX1]={}",
        even.step_mm, even.first_mm
    );
    let _ = writeln!(
        text,
        "$AA_ENC_COMP_MAX[0,AX1]={}\n$AA_ENC_COMP_IS_MODULO[0,AX1]=0",
        even.last_mm()
    );
    text.push_str("M17\n");
    Ok(text)
}

/// What stands beside the values.
const OTHERS: &[&str] = &["$AA_ENC_COMP_MAX", "$AA_ENC_COMP_IS"];

fn read(text: &str) -> Outcome<PitchTable> {
    let (mut values, mut step, mut first) = (Vec::new(), 0.0, 0.0);
    for (i, line) in text.lines().enumerate() {
        let line = line.trim();
        if is_frame(line, OTHERS) {
            continue;
        }
        if let Some((_, value)) = variable(line, "$AA_ENC_COMP_STEP") {
            step = value;
        } else if let Some((_, value)) = variable(line, "$AA_ENC_COMP_MIN") {
            first = value;
        } else {
            let found = variable(line, "$AA_ENC_COMP").map(|(_, value)| -1e3 * value);
            values.push(found.ok_or_else(|| strange(i, "`$AA_ENC_COMP[0,0,AX1]=0.001`"))?);
        }
    }
    Ok(evenly([first, step], &values, &values))
}
