//! Delimiter and columns, as the header row tells them.

use super::column::{Column, column_of};
use crate::ground::problem::{Outcome, Problem};

/// Delimiter and columns as the header row tells them.
pub(super) struct Layout {
    pub(super) delimiter: u8,
    pub(super) columns: Vec<Column>,
    pub(super) header_line: usize,
}

/// No kind of measurement has more columns.
const MOST_COLUMNS: usize = 1024;

impl Layout {
    pub(super) fn of_header(header: &str, line: usize) -> Outcome<Self> {
        let delimiter = [b'\t', b';', b',']
            .into_iter()
            .find(|d| header.bytes().any(|b| b == *d))
            .unwrap_or(b',');
        let count = header.bytes().filter(|b| *b == delimiter).count() + 1;
        if count > MOST_COLUMNS {
            return Err(Problem::new(
                format!("the header has {count} columns"),
                format!("keep the columns that the kind knows; at most {MOST_COLUMNS} are read"),
            )
            .at_line(line));
        }
        let columns = header
            .split(delimiter as char)
            .map(|name| column_of(name.trim().trim_matches('"').trim()))
            .collect::<Outcome<Vec<_>>>()
            .map_err(|p| p.at_line(line))?;
        let layout = Self {
            delimiter,
            columns,
            header_line: line,
        };
        layout.reject_doubles().map_err(|p| p.at_line(line))?;
        Ok(layout)
    }

    fn reject_doubles(&self) -> Outcome<()> {
        for (i, column) in self.columns.iter().enumerate() {
            if self.columns[..i]
                .iter()
                .any(|other| other.stem == column.stem)
            {
                return Err(Problem::new(
                    format!("`{}` occurs twice", column.stem),
                    "give every column its own name",
                )
                .in_column(&column.name));
            }
        }
        Ok(())
    }
}
