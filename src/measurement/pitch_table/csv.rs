//! CSV with front matter: `target_mm, forward_um, backward_um`.

use super::{Exporter, PitchTable, Row, numbers, strange};
use crate::ground::problem::Outcome;
use std::fmt::Write;

pub(super) const EXPORTER: Exporter = Exporter {
    name: "csv",
    ending: ".csv",
    about: "corrections in µm, to be added to the command",
    write,
    read,
};

const HEADER: &str = "target_mm,forward_um,backward_um";

fn write(table: &PitchTable) -> Outcome<String> {
    let mut text = String::from("# kind = \"pitch-table\"\n");
    if table.synthetic {
        text.push_str("# synthetic = true\n");
    }
    let inputs = table.inputs.iter().map(|input| format!("{input:?}"));
    let _ = writeln!(
        text,
        "# inputs = [{}]",
        inputs.collect::<Vec<_>>().join(", ")
    );
    let _ = writeln!(
        text,
        "# notes = {{ use = \"to be added to the command\", ident = \"{}\" }}",
        env!("CARGO_PKG_VERSION")
    );
    let _ = writeln!(text, "{HEADER}");
    for row in &table.rows {
        let _ = writeln!(
            text,
            "{},{:.4},{:.4}",
            row.target_mm, row.forward_um, row.backward_um
        );
    }
    Ok(text)
}

fn read(text: &str) -> Outcome<PitchTable> {
    let mut table = PitchTable::default();
    for (i, line) in text.lines().enumerate() {
        if line.starts_with('#') || line.trim().is_empty() || line == HEADER {
            continue;
        }
        let cells = numbers(line, |c| c == ',');
        let row = cells.filter(|cells| cells.len() == 3);
        let cells = row.ok_or_else(|| strange(i, HEADER))?;
        table.rows.push(Row {
            target_mm: cells[0],
            forward_um: cells[1],
            backward_um: cells[2],
        });
    }
    Ok(table)
}
