//! Siemens SINUMERIK, interpolatory compensation of an axis by itself (CEC): two tables, one for each
//! direction, whose values in mm are added to the command. `$AN_CEC_DIRECTION` 1: on the way in positive
//! direction only, -1: in negative (SINUMERIK Extended Functions, K3, 03/2013, p. 249). That manual says the
//! sign for the encoder's table only (p. 238; see `siemens_eec`), here that the setpoint is modified: so the
//! file asks for a trial at one point.

use super::resample::{Even, evenly, is_frame, variable};
use super::{Exporter, PitchTable, strange};
use crate::ground::problem::Outcome;
use std::fmt::Write;

pub(super) const EXPORTER: Exporter = Exporter {
    name: "siemens-cec",
    ending: ".spf",
    about: "SINUMERIK $AN_CEC: one table per direction, at equal distances, mm, added to the command",
    write,
    read,
};

fn write(table: &PitchTable) -> Outcome<String> {
    let even = Even::of(table)?;
    let mut text = String::from("%_N_NC_CEC_INI\nCHANDATA(1)\n");
    for remark in table.remarks() {
        let _ = writeln!(text, "; {remark}");
    }
    text.push_str(
        "; axis AX1 corrects itself: replace its name; values in mm, added to the setpoint\n",
    );
    text.push_str(
        "; before use: enter one value alone and see that the axis moves by it, sign included\n",
    );
    for (t, direction) in [(0, 1), (1, -1)] {
        for (i, row) in even.rows.iter().enumerate() {
            let value = if t == 0 {
                row.forward_um
            } else {
                row.backward_um
            };
            let _ = writeln!(text, "$AN_CEC[{t},{i}]={:.6}", value * 1e-3);
        }
        let _ = writeln!(
            text,
            "$AN_CEC_INPUT_AXIS[{t}]=(AX1)\n$AN_CEC_OUTPUT_AXIS[{t}]=(AX1)"
        );
        let _ = writeln!(
            text,
            "$AN_CEC_STEP[{t}]={}\n$AN_CEC_MIN[{t}]={}",
            even.step_mm, even.first_mm
        );
        let _ = writeln!(
            text,
            "$AN_CEC_MAX[{t}]={}\n$AN_CEC_DIRECTION[{t}]={direction}",
            even.last_mm()
        );
        let _ = writeln!(text, "$AN_CEC_IS_MODULO[{t}]=0");
    }
    text.push_str("M17\n");
    Ok(text)
}

/// What stands beside the values.
const OTHERS: &[&str] = &[
    "$AN_CEC_INPUT",
    "$AN_CEC_OUTPUT",
    "$AN_CEC_MAX",
    "$AN_CEC_DIR",
    "$AN_CEC_IS",
];

fn read(text: &str) -> Outcome<PitchTable> {
    let (mut values, mut step, mut first) = ([Vec::new(), Vec::new()], 0.0, 0.0);
    for (i, line) in text.lines().enumerate() {
        let line = line.trim();
        if is_frame(line, OTHERS) {
            continue;
        }
        if let Some((_, value)) = variable(line, "$AN_CEC_STEP") {
            step = value;
        } else if let Some((_, value)) = variable(line, "$AN_CEC_MIN") {
            first = value;
        } else {
            let found = variable(line, "$AN_CEC").and_then(|(at, value)| {
                let table: usize = at.first()?.trim().parse().ok()?;
                Some((table, value))
            });
            let own = found.and_then(|(table, value)| Some((values.get_mut(table)?, value)));
            let (own, value) = own.ok_or_else(|| strange(i, "`$AN_CEC[0,0]=0.001`"))?;
            own.push(value * 1e3);
        }
    }
    let [forward, backward] = values;
    Ok(evenly([first, step], &forward, &backward))
}
