//! Sheets as text for a terminal of 100 columns.

use super::wrap::wrap_columns;
use crate::sheet::table::Table;

/// Columns of a terminal line.
const COLUMNS: usize = 100;
/// Between two columns of a table.
const GAP: usize = 2;
/// No column is made narrower than this to fit a line.
const NARROWEST: usize = 12;

/// A table with aligned columns; cells that are too long for a line are broken.
///
/// ```
/// use ident::report::text;
/// use ident::sheet::table::Table;
/// let table = Table::new("Stiffness", ["joint", "N·m/rad"]).numeric([1]).with(["A1", "5.6e6"]);
/// assert_eq!(text::table(&table), "Stiffness\n\njoint  N·m/rad\n-----  -------\nA1       5.6e6\n");
/// ```
pub fn table(table: &Table) -> String {
    let widths = widths(table);
    let mut out = String::new();
    if !table.title.is_empty() {
        paragraph(&table.title, &mut out);
        out.push('\n');
    }
    if !table.header.is_empty() {
        row(&table.header, &widths, table, &mut out);
        let rules: Vec<String> = widths.iter().map(|w| "-".repeat(*w)).collect();
        row(&rules, &widths, table, &mut out);
    }
    for cells in &table.rows {
        row(cells, &widths, table, &mut out);
    }
    for note in &table.notes {
        paragraph(note, &mut out);
    }
    out
}

/// A paragraph within a line's length, every line of it indented.
///
/// ```
/// assert_eq!(ident::report::text::indented("a b", 2), "  a b\n");
/// ```
pub fn indented(text: &str, indent: usize) -> String {
    wrap_columns(text, COLUMNS - indent)
        .iter()
        .map(|line| format!("{:indent$}{line}\n", ""))
        .collect()
}

fn paragraph(text: &str, out: &mut String) {
    for line in wrap_columns(text, COLUMNS) {
        out.push_str(&line);
        out.push('\n');
    }
}

fn length(text: &str) -> usize {
    text.chars().count()
}

/// Width of each column: its longest cell. Until a row fits a line, first the headings are broken
/// into their words, then the widest columns are narrowed.
fn widths(table: &Table) -> Vec<usize> {
    let cells = |k: usize| table.rows.iter().filter_map(move |row| row.get(k));
    let heading = |k: usize| table.header.get(k).map_or("", String::as_str);
    let longest = |k: usize| cells(k).map(|cell| length(cell)).max().unwrap_or(0);
    let word = |k: usize| heading(k).split(' ').map(length).max().unwrap_or(0);
    let columns = 0..table.columns();
    let room = COLUMNS.saturating_sub(GAP * columns.len().saturating_sub(1));
    let whole = |k: usize| longest(k).max(length(heading(k)));
    let mut widths: Vec<usize> = columns.clone().map(whole).collect();
    if widths.iter().sum::<usize>() > room {
        widths = columns.map(|k| longest(k).max(word(k))).collect();
    }
    while widths.iter().sum::<usize>() > room {
        match widths.iter_mut().max() {
            Some(widest) if *widest > NARROWEST => *widest -= 1,
            _ => break,
        }
    }
    widths
}

fn row(cells: &[String], widths: &[usize], table: &Table, out: &mut String) {
    let cell = |k: usize| wrap_columns(cells.get(k).map_or("", String::as_str), widths[k]);
    let columns: Vec<Vec<String>> = (0..widths.len()).map(cell).collect();
    let lines = columns.iter().map(Vec::len).max().unwrap_or(0);
    for i in 0..lines {
        let part = |k: usize| columns[k].get(i).map_or("", String::as_str);
        let parts = (0..widths.len()).map(|k| padded(part(k), widths[k], table.is_right(k)));
        let line = parts.collect::<Vec<_>>().join(&" ".repeat(GAP));
        out.push_str(line.trim_end());
        out.push('\n');
    }
}

fn padded(text: &str, width: usize, right: bool) -> String {
    if right {
        format!("{text:>width$}")
    } else {
        format!("{text:<width$}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_cells_are_broken_within_the_line() {
        let long = "a rather long sentence about what was found ".repeat(5);
        let made = Table::new("", ["cause", "why"]).with(["backlash", long.as_str()]);
        let text = table(&made);
        assert!(text.lines().all(|line| length(line) <= COLUMNS), "{text}");
        assert!(text.lines().nth(3).unwrap().starts_with("          "));
    }

    #[test]
    fn headings_are_broken_before_cells() {
        let made =
            Table::new("", ["a quite long heading of a column"; 6]).with(["0123456789 0"; 6]);
        let text = table(&made);
        assert!(text.lines().all(|line| length(line) <= COLUMNS), "{text}");
        assert!(text.contains("0123456789 0  0123456789 0"), "{text}");
    }

    #[test]
    fn ragged_and_empty_tables_do_no_harm() {
        assert_eq!(table(&Table::default()), "");
        let ragged = Table::new("", ["a"])
            .with(["1", "2"])
            .with([""; 0])
            .noted("n");
        assert_eq!(table(&ragged), "a\n-  -\n1  2\nn\n");
    }
}
