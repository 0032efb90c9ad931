//! MAT files of MATLAB, version 5 (v6, v7; MathWorks, "MAT-File Format"): numeric variables as columns, the
//! fields of a structure as a table of their own.

mod element;

use super::Sheet;
use super::grid::{Column, sheets};
use crate::ground::problem::{Outcome, Problem};
use element::{Array, elements};

/// Bytes of the head.
const HEAD: usize = 128;

pub(super) fn recognises(bytes: &[u8]) -> bool {
    bytes.starts_with(b"MATLAB") && bytes.len() > HEAD
}

pub(super) fn read(bytes: &[u8]) -> Outcome<Vec<Sheet>> {
    if bytes.starts_with(b"MATLAB 7.3") {
        return Err(Problem::new(
            "is a MAT file of version 7.3 (HDF5), which is not read",
            "save it again in MATLAB with save(file, '-v7'), or with scipy.io.savemat",
        ));
    }
    let big = match &bytes[HEAD - 2..HEAD] {
        b"IM" => false,
        b"MI" => true,
        _ => return Err(super::bytes::cut()),
    };
    let mut variables = Vec::new();
    elements(&bytes[HEAD..], big, 0, &mut variables)?;
    let (tables, loose): (Vec<Array>, Vec<Array>) = variables
        .into_iter()
        .partition(|array| !array.fields.is_empty());
    let mut all = sheets("variables", loose.into_iter().flat_map(columns).collect());
    for table in tables {
        let own = table.fields.into_iter().flat_map(columns).collect();
        all.extend(sheets(&table.name, own));
    }
    Ok(all)
}

/// A vector as one column, a matrix as one per column of it.
fn columns(array: Array) -> Vec<Column> {
    let [rows, width] = match array.size {
        [1, n] => [n, 1],
        size => size,
    };
    if rows == 0 || width == 0 || array.values.len() != rows * width {
        return Vec::new();
    }
    let title = |k: usize| match width {
        1 => array.name.clone(),
        _ => format!("{} column {}", array.name, k + 1),
    };
    let parts = array.values.chunks(rows).enumerate();
    let column = |(k, values): (usize, &[f64])| Column {
        title: title(k),
        values: values.to_vec(),
    };
    parts.map(column).collect()
}
