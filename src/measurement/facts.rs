//! What every kind asks of its front matter and columns: known keys, columns with the right unit.

use super::table::{Cells, Table};
use crate::ground::problem::{Outcome, Problem};
use crate::ground::units::Dimension;

/// The numbers of a column, if the file has it, after a look at its unit.
///
/// # Errors
/// The column holds another quantity.
pub(super) fn measured<'a>(
    table: &'a Table,
    stem: &str,
    wanted: Dimension,
) -> Outcome<Option<&'a [f64]>> {
    let Some(column) = table.column(stem) else {
        return Ok(None);
    };
    match (&column.cells, column.dimension) {
        (Cells::Numbers(values), Some(found)) if found == wanted => Ok(Some(values)),
        _ => Err(column.misplaced(wanted, table.first_line - 1)),
    }
}

/// [`measured`], refused where it is absent.
///
/// # Errors
/// As [`measured`], or the column is missing: `header` shows what the kind writes.
pub(super) fn needed<'a>(
    table: &'a Table,
    stem: &str,
    wanted: Dimension,
    header: &str,
) -> Outcome<&'a [f64]> {
    measured(table, stem, wanted)?.ok_or_else(|| missing(table, stem, header))
}

/// A column that the kind needs and the file does not have.
pub(super) fn missing(table: &Table, stem: &str, header: &str) -> Problem {
    Problem::new(
        format!("has no column `{stem}`"),
        format!("the header of this kind is `{header}`"),
    )
    .at_line(table.first_line - 1)
}

/// File name without its ending.
pub(super) fn stem(path: &std::path::Path, otherwise: &str) -> String {
    let stem = path.file_stem().map(|s| s.to_string_lossy().to_string());
    stem.unwrap_or_else(|| otherwise.into())
}
