//! The general reader: CSV with front matter, units in the column names, into SI columns.
//!
//! One pass, row by row; memory is the numbers and one line. Delimiter (`,` `;` tab) and decimal
//! comma are recognised from the header and the cells.

use super::front::Front;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::units::{self, Dimension};
use sha2::{Digest, Sha256};
use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};

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

/// A measurement file as read: facts and columns.
#[derive(Debug, Clone)]
pub struct Table {
    /// Where it came from.
    pub path: PathBuf,
    /// SHA-256 of the file.
    pub sha256: String,
    /// Its facts.
    pub front: Front,
    /// Its columns, in file order.
    pub columns: Vec<Column>,
    /// Number of data rows.
    pub rows: usize,
    /// Delimiter found.
    pub delimiter: char,
    /// Whether numbers use a decimal comma.
    pub decimal_comma: bool,
    /// 1-based line of the first data row.
    pub first_line: usize,
    /// Rows that do not stand on the line after the row before, and their 1-based lines.
    jumps: Vec<(usize, usize)>,
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
];

impl Table {
    /// Reads a file.
    pub fn read(path: &Path) -> Outcome<Self> {
        let open = || {
            let file = File::open(path)?;
            let bytes = file.metadata()?.len();
            Ok((file, bytes))
        };
        let (file, bytes) = open().map_err(|e| unreadable(&e).in_file(path))?;
        Self::from_reader(path, file, bytes)
    }

    /// Reads a table from any source; `path` names it, `bytes` (any good guess) is its length.
    pub fn from_reader(path: &Path, source: impl Read, bytes: u64) -> Outcome<Self> {
        Self::parse(path, source, bytes).map_err(|problem| problem.in_file(path))
    }

    /// The column with this stem, if present.
    pub fn column(&self, stem: &str) -> Option<&Column> {
        self.columns.iter().find(|column| column.stem == stem)
    }

    /// 1-based line on which a data row stands.
    pub fn line_of(&self, row: usize) -> usize {
        match self.jumps.partition_point(|jump| jump.0 <= row) {
            0 => self.first_line + row,
            n => self.jumps[n - 1].1 + row - self.jumps[n - 1].0,
        }
    }

    fn parse(path: &Path, source: impl Read, bytes: u64) -> Outcome<Self> {
        let mut reader = BufReader::with_capacity(1 << 18, Hashing::new(source));
        let (front, header, header_line) = read_head(&mut reader)?;
        let layout = Layout::of_header(&header, header_line)?;
        let mut body = Body::new(layout, bytes as usize, header.len());
        body.read(&mut reader)?;
        let digest = reader.into_inner().finish();
        Ok(Self {
            path: path.to_path_buf(),
            sha256: digest,
            front,
            rows: body.rows,
            delimiter: body.layout.delimiter as char,
            decimal_comma: body.decimal_comma == Some(true),
            first_line: header_line + 1,
            columns: body.columns,
            jumps: body.jumps,
        })
    }
}

/// The front matter of a file, without its rows, if it can be read that far.
pub fn front_of(path: &Path) -> Option<Front> {
    let mut reader = BufReader::new(File::open(path).ok()?);
    Some(read_head(&mut reader).ok()?.0)
}

/// The kind that a file's front matter names, if it can be read that far.
pub fn kind_of(path: &Path) -> Option<String> {
    Some(front_of(path)?.text("kind").ok()??.to_string())
}

fn unreadable(error: &std::io::Error) -> Problem {
    let remedy = match error.kind() {
        std::io::ErrorKind::NotFound => "check the path; no such file is there",
        std::io::ErrorKind::PermissionDenied => "make the file readable for this user",
        _ => "check that it is a regular, readable file",
    };
    Problem::new(format!("cannot be read ({error})"), remedy)
}

/// A reader that hashes what passes through it and refuses endless lines.
struct Hashing<R> {
    source: R,
    digest: Sha256,
    since_line_end: usize,
}

impl<R: Read> Hashing<R> {
    fn new(source: R) -> Self {
        Self {
            source,
            digest: Sha256::new(),
            since_line_end: 0,
        }
    }

    /// The digest of all that was read; the body is read to its end before.
    fn finish(self) -> String {
        let bytes = self.digest.finalize();
        bytes.iter().map(|b| format!("{b:02x}")).collect()
    }
}

impl<R: Read> Read for Hashing<R> {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        let n = self.source.read(buffer)?;
        self.digest.update(&buffer[..n]);
        self.since_line_end = match buffer[..n].iter().rposition(|b| *b == b'\n') {
            Some(at) => n - at - 1,
            None => self.since_line_end + n,
        };
        if self.since_line_end > LONGEST_LINE {
            return Err(std::io::Error::other("line longer than any row of a table"));
        }
        Ok(n)
    }
}

/// Longest line accepted: longer ones are no table, and must not fill the memory.
const LONGEST_LINE: usize = 1 << 20;

fn read_line(reader: &mut impl BufRead, line: usize) -> Outcome<Option<String>> {
    let mut bytes = Vec::new();
    let n = reader
        .read_until(b'\n', &mut bytes)
        .map_err(|e| unreadable(&e).at_line(line))?;
    if n == 0 {
        return Ok(None);
    }
    if line == 1 {
        reject_binary(&bytes)?;
        if bytes.starts_with(b"\xEF\xBB\xBF") {
            bytes.drain(..3);
        }
    }
    let not_text =
        || Problem::new("is not UTF-8 text", "export the table as CSV in UTF-8").at_line(line);
    if bytes.contains(&0) {
        return Err(not_text());
    }
    let text = String::from_utf8(bytes).map_err(|_| not_text())?;
    Ok(Some(text.trim_end_matches(['\n', '\r']).to_string()))
}

fn reject_binary(start: &[u8]) -> Outcome<()> {
    if start.starts_with(b"\xFF\xFE") || start.starts_with(b"\xFE\xFF") {
        return Err(Problem::new("is UTF-16 text", "save it as UTF-8").at_line(1));
    }
    if start.starts_with(b"PK\x03\x04") {
        return Err(Problem::new(
            "is a spreadsheet or archive, not a CSV table",
            "export the sheet as CSV (UTF-8)",
        )
        .at_line(1));
    }
    Ok(())
}

fn read_head(reader: &mut impl BufRead) -> Outcome<(Front, String, usize)> {
    let mut front = String::new();
    let mut line = 0;
    loop {
        line += 1;
        let Some(text) = read_line(reader, line)? else {
            let what = if line == 1 {
                "is empty"
            } else {
                "has no header row"
            };
            return Err(Problem::new(
                what,
                "write the facts in `#` lines, then one header row such as `time_s,force_N,displacement_mm`, then numbers",
            )
            .at_line(line));
        };
        match text.strip_prefix('#') {
            Some(rest) => front.push_str(rest.strip_prefix(' ').unwrap_or(rest)),
            None if text.trim().is_empty() => {}
            None => return Ok((Front::parse(front)?, text, line)),
        }
        front.push('\n');
    }
}

/// Delimiter and columns as the header row tells them.
struct Layout {
    delimiter: u8,
    columns: Vec<Column>,
    header_line: usize,
}

impl Layout {
    fn of_header(header: &str, line: usize) -> Outcome<Self> {
        let delimiter = [b'\t', b';', b',']
            .into_iter()
            .find(|d| header.bytes().any(|b| b == *d))
            .unwrap_or(b',');
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

fn column_of(name: &str) -> Outcome<Column> {
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

/// The numbers as they are read, row by row.
struct Body {
    layout: Layout,
    columns: Vec<Column>,
    rows: usize,
    jumps: Vec<(usize, usize)>,
    next_line: usize,
    decimal_comma: Option<bool>,
    bytes: usize,
    header_length: usize,
}

impl Body {
    fn new(mut layout: Layout, bytes: usize, header_length: usize) -> Self {
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

    fn read(&mut self, reader: &mut impl BufRead) -> Outcome<()> {
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

/// A decimal comma shows in the first row that has a comma or a point in a number; a row with both
/// is refused, whichever it is.
fn decide_decimal(row: &[u8], delimiter: u8) -> Option<bool> {
    let comma = delimiter != b',' && row.contains(&b',');
    match (comma, row.contains(&b'.')) {
        (true, true) => None,
        (true, false) => Some(true),
        (false, true) => Some(false),
        (false, false) => None,
    }
}

impl Column {
    fn push(&mut self, cell: &[u8], comma: bool) -> Outcome<()> {
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

fn number(cell: &[u8], comma: bool) -> Outcome<f64> {
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

fn in_si(cell: &[u8], value: f64, factor: f64) -> Outcome<f64> {
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
