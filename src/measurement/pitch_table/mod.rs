//! The table that corrects a screw, and the controllers that read it. A further controller is one file
//! and one line in [`EXPORTERS`].

mod csv;
mod galil;
mod linuxcnc;
mod resample;
mod siemens_cec;
mod siemens_eec;

use crate::ground::problem::{Outcome, Problem};

/// Corrections of one axis, to be added to the command.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PitchTable {
    /// The targets, strictly rising.
    pub rows: Vec<Row>,
    /// What the table rests on, one line each: file and hash.
    pub inputs: Vec<String>,
    /// Made from simulated measurements.
    pub synthetic: bool,
}

/// One target of a [`PitchTable`].
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Row {
    /// Commanded position, mm.
    pub target_mm: f64,
    /// Correction on the way in positive direction, µm.
    pub forward_um: f64,
    /// Correction on the way in negative direction, µm.
    pub backward_um: f64,
}

/// A controller's form of the table.
pub struct Exporter {
    /// Its name as typed.
    pub name: &'static str,
    /// Ending of its files, with the dot.
    pub ending: &'static str,
    /// What it is and how it takes the numbers, one sentence.
    pub about: &'static str,
    /// Writes the table.
    pub write: fn(&PitchTable) -> Outcome<String>,
    /// Reads it back.
    pub read: fn(&str) -> Outcome<PitchTable>,
}

/// Every form, the first being the one that is written unless another is asked for.
pub const EXPORTERS: &[Exporter] = &[
    csv::EXPORTER,
    linuxcnc::EXPORTER,
    galil::EXPORTER,
    siemens_cec::EXPORTER,
    siemens_eec::EXPORTER,
];

/// The exporter with this name.
///
/// # Errors
/// There is none: all names are told.
pub fn exporter(name: &str) -> Outcome<&'static Exporter> {
    let found = EXPORTERS.iter().find(|exporter| exporter.name == name);
    found.ok_or_else(|| {
        let known: Vec<&str> = EXPORTERS.iter().map(|exporter| exporter.name).collect();
        Problem::new(
            format!("`{name}` is no form of a pitch table"),
            format!("choose one of: {}", known.join(", ")),
        )
        .in_column("--format")
    })
}

impl PitchTable {
    /// Correction at a position, µm: straight lines between the targets, constant outside.
    pub fn correction_um(&self, position_mm: f64, forward: bool) -> f64 {
        let value = |row: &Row| {
            if forward {
                row.forward_um
            } else {
                row.backward_um
            }
        };
        let after = self
            .rows
            .partition_point(|row| row.target_mm <= position_mm);
        match (
            after.checked_sub(1).map(|i| &self.rows[i]),
            self.rows.get(after),
        ) {
            (Some(a), Some(b)) => {
                let share = (position_mm - a.target_mm) / (b.target_mm - a.target_mm);
                value(a) + share * (value(b) - value(a))
            }
            (Some(end), None) | (None, Some(end)) => value(end),
            (None, None) => 0.0,
        }
    }

    /// Lines that say where the table comes from.
    fn remarks(&self) -> Vec<String> {
        let label = self
            .synthetic
            .then(|| "synthetic: from simulated measurements".to_string());
        let made = format!("pitch table by ident {}", env!("CARGO_PKG_VERSION"));
        label
            .into_iter()
            .chain([made])
            .chain(self.inputs.iter().cloned())
            .collect()
    }
}

/// Splits the numbers of one line; remarks start with one of `comment`.
fn numbers(line: &str, split: impl Fn(char) -> bool) -> Option<Vec<f64>> {
    let cells = line
        .split(split)
        .map(str::trim)
        .filter(|cell| !cell.is_empty());
    cells
        .map(|cell| cell.parse().ok().filter(|x: &f64| x.is_finite()))
        .collect()
}

/// A line that the form does not allow.
fn strange(line: usize, wanted: &str) -> Problem {
    Problem::new("is no line of this table", format!("write {wanted}")).at_line(line + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> PitchTable {
        let row = |i: i32| Row {
            target_mm: -41.0 + 5.25 * f64::from(i),
            forward_um: f64::from(i * i % 17) - 3.4,
            backward_um: 5.1 - f64::from(i),
        };
        PitchTable {
            rows: (0..12).map(row).collect(),
            inputs: vec!["x.csv 00aa".into()],
            synthetic: true,
        }
    }

    #[test]
    fn every_form_is_read_back_as_it_was_written() {
        for exporter in EXPORTERS {
            let text = (exporter.write)(&table()).unwrap();
            assert!(
                text.contains("synthetic") && text.contains("00aa"),
                "{}",
                exporter.name
            );
            let back = (exporter.read)(&text).unwrap();
            assert_eq!(back.rows.len(), 12, "{}", exporter.name);
            for (a, b) in back.rows.iter().zip(&table().rows) {
                let mean = 0.5 * (b.forward_um + b.backward_um);
                let one = exporter.name == "siemens-eec";
                let (forward, backward) = if one {
                    (mean, mean)
                } else {
                    (b.forward_um, b.backward_um)
                };
                assert!(
                    (a.target_mm - b.target_mm).abs() < 1e-9,
                    "{}",
                    exporter.name
                );
                assert!((a.forward_um - forward).abs() < 1e-3, "{}", exporter.name);
                assert!((a.backward_um - backward).abs() < 1e-3, "{}", exporter.name);
            }
        }
    }

    #[test]
    fn a_broken_line_is_refused_with_its_number() {
        for exporter in EXPORTERS {
            let text = (exporter.write)(&table()).unwrap();
            let lines = text.lines().count();
            let problem = (exporter.read)(&(text + "nonsense\n")).unwrap_err();
            assert_eq!(problem.line, Some(lines + 1), "{}", exporter.name);
        }
    }

    #[test]
    fn between_targets_the_correction_is_a_straight_line_and_outside_it_stays() {
        let table = table();
        assert_eq!(table.correction_um(-100.0, true), table.rows[0].forward_um);
        assert_eq!(
            table.correction_um(1000.0, false),
            table.rows[11].backward_um
        );
        let middle = table.correction_um(-41.0 + 2.625, false);
        assert!((middle - (5.1 - 0.5)).abs() < 1e-12);
    }
}
