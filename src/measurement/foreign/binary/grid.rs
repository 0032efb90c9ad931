//! Columns of numbers as lines of text.

use super::{DELIMITER, Sheet};
use std::fmt::Write;

/// A column: its title, with its unit in brackets if that is known, and its numbers.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Column {
    pub(super) title: String,
    pub(super) values: Vec<f64>,
}

/// A text as one cell.
pub(super) fn cell(text: &str) -> String {
    text.replace(['\t', '\n', '\r'], " ").trim().to_string()
}

/// A number as a cell: what is no number is a missing value, since these formats know no empty cell.
pub(super) fn number(value: f64) -> String {
    match value.is_nan() {
        true => String::new(),
        false => format!("{value:?}"),
    }
}

/// One sheet per length of columns, in the order of their first columns; lone columns and single numbers
/// make no table.
pub(super) fn sheets(name: &str, columns: Vec<Column>) -> Vec<Sheet> {
    let mut lengths: Vec<usize> = Vec::new();
    for column in &columns {
        let length = column.values.len();
        if length > 1 && !lengths.contains(&length) {
            lengths.push(length);
        }
    }
    let several = lengths.len() > 1;
    let sheet = |length: &usize| {
        let own: Vec<&Column> = columns
            .iter()
            .filter(|c| c.values.len() == *length)
            .collect();
        let name = match several {
            true => format!("{name} ({length} rows)"),
            false => name.to_string(),
        };
        (own.len() > 1).then(|| Sheet {
            name: name.trim().to_string(),
            text: text(&own, *length),
        })
    };
    lengths.iter().filter_map(sheet).collect()
}

fn text(columns: &[&Column], rows: usize) -> String {
    let mut text = String::with_capacity(rows * columns.len() * 12);
    line(&mut text, columns.iter().map(|column| cell(&column.title)));
    for row in 0..rows {
        line(
            &mut text,
            columns.iter().map(|column| number(column.values[row])),
        );
    }
    text
}

/// Appends a line of cells.
pub(super) fn line(text: &mut String, cells: impl Iterator<Item = String>) {
    for (i, cell) in cells.enumerate() {
        if i > 0 {
            text.push(DELIMITER);
        }
        let _ = write!(text, "{cell}");
    }
    text.push('\n');
}
