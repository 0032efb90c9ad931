//! Spreadsheets (`.xlsx`): every sheet with its cells as they stand, so that the lines keep their numbers.

use super::Sheet;
use super::grid::{cell, line, number};
use crate::ground::problem::{Outcome, Problem};
use calamine::{DataRef, Reader, Xlsx, XlsxError};
use std::collections::BTreeMap;
use std::io::Cursor;

/// What helps where a workbook cannot be read.
const REMEDY: &str = "save it again as .xlsx, or export it as CSV";
/// Cells of a sheet at most, empty ones with them.
const LARGEST: u64 = 100_000_000;

pub(super) fn recognises(bytes: &[u8]) -> bool {
    let names = |name: &[u8]| bytes.windows(name.len()).any(|w| w == name);
    bytes.starts_with(b"PK\x03\x04") && names(b"xl/")
}

/// Every sheet. A spoiled reference of a cell makes the reader of the format count beyond its numbers: what it panics of is
/// a file that cannot be read. Nothing of this project runs inside but the copying of cells; what another thread panics of
/// meanwhile is not printed.
pub(super) fn read(bytes: &[u8]) -> Outcome<Vec<Sheet>> {
    let said = std::panic::take_hook();
    std::panic::set_hook(Box::new(|_| {}));
    let sheets = std::panic::catch_unwind(|| sheets(bytes));
    std::panic::set_hook(said);
    sheets.unwrap_or_else(|_| {
        Err(Problem::new(
            "is no spreadsheet that can be read: a cell or the extent of a sheet has a place that is none",
            REMEDY,
        ))
    })
}

fn sheets(bytes: &[u8]) -> Outcome<Vec<Sheet>> {
    let mut book: Xlsx<_> = Xlsx::new(Cursor::new(bytes)).map_err(refused)?;
    let mut sheets = Vec::new();
    for name in book.sheet_names() {
        let mut cells = book.worksheet_cells_reader(&name).map_err(refused)?;
        let mut grid = Grid::default();
        while let Some(cell) = cells.next_cell().map_err(refused)? {
            grid.put(cell.get_position(), shown(cell.get_value()));
        }
        if grid.width > 1 {
            let text = grid.text()?;
            sheets.push(Sheet { name, text });
        }
    }
    Ok(sheets)
}

fn refused(error: XlsxError) -> Problem {
    let what = format!("is no spreadsheet that can be read: {error}");
    Problem::new(what, REMEDY)
}

/// Cells that hold something, row by row.
#[derive(Default)]
struct Grid {
    rows: BTreeMap<u32, BTreeMap<u32, String>>,
    width: u32,
}

impl Grid {
    fn put(&mut self, (row, column): (u32, u32), text: String) {
        if !text.is_empty() {
            self.rows.entry(row).or_default().insert(column, text);
            self.width = self.width.max(column.saturating_add(1));
        }
    }

    /// All rows from the first of the sheet on, each with all columns.
    fn text(&self) -> Outcome<String> {
        let last = self.rows.keys().next_back().map_or(0, |row| row + 1);
        if u64::from(last) * u64::from(self.width) > LARGEST {
            let what = format!("has a sheet of {last} rows and {} columns", self.width);
            return Err(Problem::new(
                what,
                "remove what stands far outside of the table",
            ));
        }
        let (none, mut text) = (BTreeMap::new(), String::new());
        for row in 0..last {
            let own = self.rows.get(&row).unwrap_or(&none);
            let cells = (0..self.width).map(|column| own.get(&column).cloned());
            line(&mut text, cells.map(Option::unwrap_or_default));
        }
        Ok(text)
    }
}

/// A cell: numbers in full, dates and times of day in seconds, the rest as text.
fn shown(data: &DataRef) -> String {
    match data {
        DataRef::Int(whole) => whole.to_string(),
        DataRef::Float(value) => number(*value),
        DataRef::DateTime(time) => number(time.as_f64() * 86_400.0),
        DataRef::Bool(yes) => u8::from(*yes).to_string(),
        DataRef::String(text) | DataRef::DateTimeIso(text) | DataRef::DurationIso(text) => {
            cell(text)
        }
        DataRef::SharedString(text) => cell(text),
        DataRef::Empty | DataRef::Error(_) => String::new(),
    }
}
