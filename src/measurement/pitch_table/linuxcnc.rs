//! LinuxCNC's screw compensation file for `COMP_FILE_TYPE = 1`: nominal position and the trims (nominal
//! less actual, added to the command) on the way up and down, in machine units (mm). It is read up to the
//! first line that is no triplet (`usrmotLoadComp` in src/emc/motion/usrmotintf.cc), so remarks stand last.

use super::{Exporter, PitchTable, Row, numbers, strange};
use crate::ground::problem::Outcome;
use std::fmt::Write;

pub(super) const EXPORTER: Exporter = Exporter {
    name: "linuxcnc",
    ending: ".comp",
    about: "LinuxCNC .comp for COMP_FILE_TYPE = 1: nominal, trim on the way up, trim on the way down, mm",
    write,
    read,
};

fn write(table: &PitchTable) -> Outcome<String> {
    let mut text = String::new();
    for row in &table.rows {
        let (up, down) = (row.forward_um * 1e-3, row.backward_um * 1e-3);
        let _ = writeln!(text, "{} {up:.6} {down:.6}", row.target_mm);
    }
    for remark in table.remarks() {
        let _ = writeln!(text, "# {remark}");
    }
    let _ = writeln!(
        text,
        "# [JOINT_n] COMP_FILE = this file, COMP_FILE_TYPE = 1"
    );
    Ok(text)
}

fn read(text: &str) -> Outcome<PitchTable> {
    let mut table = PitchTable::default();
    for (i, line) in text.lines().enumerate() {
        if line.starts_with('#') || line.trim().is_empty() {
            continue;
        }
        let cells = numbers(line, char::is_whitespace).filter(|cells| cells.len() == 3);
        let cells = cells.ok_or_else(|| strange(i, "nominal, trim up and trim down in mm"))?;
        table.rows.push(Row {
            target_mm: cells[0],
            forward_um: cells[1] * 1e3,
            backward_um: cells[2] * 1e3,
        });
    }
    Ok(table)
}
