//! The rows under the header.

use super::cell::decide_decimal;
use super::column::{Cells, Column};
use super::layout::Layout;
use crate::ground::files::unreadable;
use crate::ground::problem::{Outcome, Problem};
use std::io::BufRead;

/// The numbers as they are read, row by row.
pub(super) struct Body {
    pub(super) layout: Layout,
    pub(super) columns: Vec<Column>,
    pub(super) rows: usize,
    pub(super) jumps: Vec<(usize, usize)>,
    next_line: usize,
    pub(super) decimal_comma: Option<bool>,
    bytes: usize,
    header_length: usize,
}

impl Body {
    pub(super) fn new(mut layout: Layout, bytes: usize, header_length: usize) -> Self {
        let columns = std::mem::take(&mut layout.columns);
        let decimal_comma = (layout.delimiter == b',').then_some(false);
        Self {
            next_line: layout.header_line + 1,
            layout,
            columns,
            rows: 0,
            jumps: Vec::new(),
            decimal_comma,
            bytes,
            header_length,
        }
    }

    pub(super) fn read(&mut self, reader: &mut impl BufRead) -> Outcome<()> {
        let mut text = Vec::new();
        for line in self.layout.header_line + 1.. {
            text.clear();
            let read = reader.read_until(b'\n', &mut text);
            if read.map_err(|e| unreadable(&e).at_line(line))? == 0 {
                break;
            }
            self.row(without_line_end(&text), line)
                .map_err(|p| p.at_line(line))?;
        }
        Ok(())
    }

    fn row(&mut self, text: &[u8], line: usize) -> Outcome<()> {
        let delimiter = self.layout.delimiter;
        let cells = || text.split(|b| *b == delimiter);
        let found = cells().count();
        if found != self.columns.len() {
            return match cells().all(|cell| cell.trim_ascii().is_empty()) {
                true => Ok(()),
                false => Err(self.wrong_length(found)),
            };
        }
        if self.rows == 0 {
            self.reserve(text.len() + 1);
        }
        if self.decimal_comma.is_none() {
            self.decimal_comma = decide_decimal(text, delimiter);
        }
        let comma = self.decimal_comma == Some(true);
        for (column, cell) in self.columns.iter_mut().zip(cells()) {
            column
                .push(unquoted(cell), comma)
                .map_err(|p| p.in_column(&column.name))?;
        }
        if line != self.next_line {
            self.jumps.push((self.rows, line));
        }
        self.next_line = line + 1;
        self.rows += 1;
        Ok(())
    }

    /// Room for as many rows as the file's size suggests, so that growing does not double memory.
    fn reserve(&mut self, row_bytes: usize) {
        let rows = self.bytes.saturating_sub(self.header_length) / row_bytes.max(2);
        let rows = (rows + rows / 16 + 16).min(1 << 28);
        for column in &mut self.columns {
            match &mut column.cells {
                Cells::Numbers(values) => values.reserve(rows),
                Cells::Words(codes, _) => codes.reserve(rows),
            }
        }
    }

    fn wrong_length(&self, found: usize) -> Problem {
        let wanted = self.columns.len();
        let remedy = if self.layout.delimiter == b',' && found == 2 * wanted {
            "decimal commas need `;` or tab between the cells: export with `;`".to_string()
        } else {
            format!(
                "give every row {wanted} cells; leave a missing value empty but keep its delimiter"
            )
        };
        Problem::new(
            format!("row has {found} cells, the header has {wanted}"),
            remedy,
        )
    }
}

fn without_line_end(line: &[u8]) -> &[u8] {
    let line = line.strip_suffix(b"\n").unwrap_or(line);
    line.strip_suffix(b"\r").unwrap_or(line)
}

/// A cell without blanks and quotes around it.
fn unquoted(cell: &[u8]) -> &[u8] {
    let cell = cell.trim_ascii();
    match cell {
        [b'"', inner @ .., b'"'] => inner.trim_ascii(),
        _ => cell,
    }
}
