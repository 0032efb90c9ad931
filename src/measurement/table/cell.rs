//! One cell: a number in SI, with a decimal point or a decimal comma.

use crate::ground::problem::{Outcome, Problem};

/// A decimal comma shows in the first row that has a comma or a point in a number; a row with both
/// is refused, whichever it is.
pub(super) fn decide_decimal(row: &[u8], delimiter: u8) -> Option<bool> {
    let comma = delimiter != b',' && row.contains(&b',');
    match (comma, row.contains(&b'.')) {
        (true, true) => None,
        (true, false) => Some(true),
        (false, true) => Some(false),
        (false, false) => None,
    }
}

pub(super) fn number(cell: &[u8], comma: bool) -> Outcome<f64> {
    let parsed = match comma {
        false => fast_float2::parse::<f64, _>(cell).ok(),
        true => parse_comma(cell),
    };
    match parsed {
        Some(value) if value.is_finite() => Ok(value),
        Some(_) => Err(Problem::new(
            format!("`{}` is not a finite number", shown(cell)),
            "leave the cell empty if the value is missing",
        )),
        None => Err(not_a_number(cell, comma)),
    }
}

/// Largest magnitude that is taken for a measured value: squares of it stay finite.
const LARGEST: f64 = 1e50;

pub(super) fn in_si(cell: &[u8], value: f64, factor: f64) -> Outcome<f64> {
    let value = value * factor;
    if value.abs() <= LARGEST {
        return Ok(value);
    }
    Err(Problem::new(
        format!("`{}` is too large for a measured value", shown(cell)),
        "check the exponent, and the unit at the end of the column name",
    ))
}

fn parse_comma(cell: &[u8]) -> Option<f64> {
    let mut buffer = [0u8; 64];
    let buffer = buffer.get_mut(..cell.len())?;
    buffer.copy_from_slice(cell);
    if buffer.contains(&b'.') {
        return None; // a thousands separator, or a second decimal sign: 1.234 would be 1234
    }
    for byte in buffer.iter_mut().filter(|b| **b == b',') {
        *byte = b'.';
    }
    fast_float2::parse::<f64, _>(&*buffer).ok()
}

fn not_a_number(cell: &[u8], comma: bool) -> Problem {
    let remedy = if cell.contains(&b',') && cell.contains(&b'.') {
        "remove the thousands separators"
    } else if cell.contains(&b',') && !comma {
        "use decimal points throughout and no thousands separators"
    } else if cell.contains(&b'.') && comma {
        "use decimal commas throughout and no thousands separators"
    } else {
        "write a number, or leave the cell empty if the value is missing"
    };
    Problem::new(format!("`{}` is not a number", shown(cell)), remedy)
}

fn shown(cell: &[u8]) -> String {
    String::from_utf8_lossy(cell)
        .chars()
        .filter(|c| !c.is_control())
        .take(24)
        .collect()
}
