//! One column: its name, its unit and its cells in SI.

use super::cell::{in_si, number};
use crate::ground::problem::{Outcome, Problem};
use crate::ground::units::{self, Dimension};

/// What a column holds.
#[derive(Debug, Clone)]
pub enum Cells {
    /// SI values; a missing cell is NaN (no other NaN can occur).
    Numbers(Vec<f64>),
    /// Words such as `x` or `forward`, as indices into the dictionary.
    Words(Vec<u16>, Vec<String>),
}

/// One column of a table.
#[derive(Debug, Clone)]
pub struct Column {
    /// Name as written in the header, unit included.
    pub name: String,
    /// Name without its unit.
    pub stem: String,
    /// What it measures; `None` for columns without a unit (point, cycle, direction ...).
    pub dimension: Option<Dimension>,
    /// Factor from the file's unit to SI.
    pub factor: f64,
    /// The values.
    pub cells: Cells,
    /// How many cells were empty.
    pub missing: usize,
}

impl Column {
    /// What is wrong with a column that should measure `wanted`; `header` is the line of the names.
    pub fn misplaced(&self, wanted: Dimension, header: usize) -> Problem {
        let found = match self.dimension {
            Some(found) => format!("has a unit of {found}"),
            None => "has no unit".into(),
        };
        Problem::new(
            format!("{found}, expected {wanted}"),
            "correct the unit at the end of the name, or swap the columns back",
        )
        .in_column(&self.name)
        .at_line(header)
    }
}

/// Columns that carry no unit, and whether they hold words.
const PLAIN: &[(&str, bool)] = &[
    ("direction", true),
    ("run", false),
    ("hit", false),
    ("cycle", false),
    ("point", false),
    ("qw", false),
    ("qx", false),
    ("qy", false),
    ("qz", false),
    ("i", false),
    ("j", false),
    ("k", false),
    ("rapid", false),
    ("weight", false),
];

pub(super) fn column_of(name: &str) -> Outcome<Column> {
    let plain = PLAIN.iter().find(|(plain, _)| *plain == name);
    let (stem, dimension, factor) = match (plain, units::split_name(name)) {
        (Some(_), _) => (name.to_string(), None, 1.0),
        (None, Some((stem, unit))) => (stem, Some(unit.dimension), unit.factor),
        (None, None) => return Err(without_unit(name)),
    };
    let words = plain.is_some_and(|(_, words)| *words);
    Ok(Column {
        name: name.to_string(),
        stem,
        dimension,
        factor,
        missing: 0,
        cells: match words {
            true => Cells::Words(Vec::new(), Vec::new()),
            false => Cells::Numbers(Vec::new()),
        },
    })
}

fn without_unit(name: &str) -> Problem {
    if !name.is_empty() && name.replace(',', ".").parse::<f64>().is_ok() {
        return Problem::new(
            format!("the header row is missing: found the number `{name}` in its place"),
            "write one header row such as `time_s,force_N,displacement_mm` before the numbers",
        );
    }
    let what = match name.rsplit_once('_') {
        _ if name.is_empty() => "column without a name".to_string(),
        Some((_, end)) => format!("unknown unit `{end}`"),
        None => "column without a unit".to_string(),
    };
    let remedy = format!(
        "end the name in its unit, as in `force_N`; known units: {}",
        units::known_units()
    );
    Problem::new(what, remedy).in_column(name)
}

impl Column {
    pub(super) fn push(&mut self, cell: &[u8], comma: bool) -> Outcome<()> {
        match &mut self.cells {
            Cells::Words(codes, words) => push_word(codes, words, cell),
            Cells::Numbers(values) if cell.is_empty() => {
                self.missing += 1;
                values.push(f64::NAN);
                Ok(())
            }
            Cells::Numbers(values) => {
                values.push(in_si(cell, number(cell, comma)?, self.factor)?);
                Ok(())
            }
        }
    }

    /// The numbers of a numeric column.
    pub fn numbers(&self) -> Option<&[f64]> {
        match &self.cells {
            Cells::Numbers(values) => Some(values),
            Cells::Words(..) => None,
        }
    }

    /// The words of a word column: codes and dictionary.
    pub fn words(&self) -> Option<(&[u16], &[String])> {
        match &self.cells {
            Cells::Words(codes, words) => Some((codes, words)),
            Cells::Numbers(_) => None,
        }
    }
}

fn push_word(codes: &mut Vec<u16>, words: &mut Vec<String>, cell: &[u8]) -> Outcome<()> {
    let word = String::from_utf8_lossy(cell).to_string();
    let code = words
        .iter()
        .position(|known| *known == word)
        .unwrap_or_else(|| {
            words.push(word);
            words.len() - 1
        });
    if code > 64 {
        return Err(Problem::new(
            "holds more than 64 different words",
            "write one of the few directions that the kind knows",
        ));
    }
    codes.push(code as u16);
    Ok(())
}
