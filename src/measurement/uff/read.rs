//! Reads data set 58.

use super::axis::Axis;
use super::binary;
use super::fields::{Record, number};
use super::function::{Abscissa, Dof, Function, Kind, Values};
use crate::ground::problem::{Outcome, Problem};
use rustfft::num_complex::Complex64;

/// Record 7: how the values are stored.
#[derive(Debug, Clone, Copy)]
pub struct Layout {
    complex: bool,
    double: bool,
    even: bool,
    /// Number of values (of pairs or triples if uneven).
    pub count: usize,
    start: f64,
    step: f64,
    z: f64,
}

impl Layout {
    /// Reads it from the records of a block.
    pub fn parse(records: &[Record]) -> Outcome<Self> {
        let record = records.get(6).ok_or_else(|| too_few(records))?;
        let (complex, double) = match record.integer(0, 10)? {
            2 => (false, false),
            4 => (false, true),
            5 => (true, false),
            6 => (true, true),
            other => return Err(unknown_type(other, record)),
        };
        let count = usize::try_from(record.integer(10, 20)?).map_err(|_| negative(record))?;
        Ok(Self {
            complex,
            double,
            even: record.integer(20, 30)? == 1,
            count,
            start: record.number(30, 43)?,
            step: record.number(43, 56)?,
            z: record.number(56, 69)?,
        })
    }

    /// Numbers per ordinate value.
    pub fn parts(&self) -> usize {
        1 + usize::from(self.complex)
    }

    /// Bytes per abscissa and per ordinate number that a binary block may have.
    pub fn widths(&self) -> Vec<(usize, usize)> {
        match (self.even, self.double) {
            (true, true) => vec![(0, 8)],
            (true, false) => vec![(0, 4), (0, 8)],
            (false, true) => vec![(8, 8), (4, 8)],
            (false, false) => vec![(4, 4), (8, 8)],
        }
    }

    /// Widths of the text fields of one value, abscissa first.
    fn fields(&self) -> Vec<usize> {
        let ordinate = if self.double { 20 } else { 13 };
        let abscissa = (!self.even).then_some(13);
        let parts = std::iter::repeat_n(ordinate, self.parts());
        abscissa.into_iter().chain(parts).collect()
    }

    fn numbers(&self) -> Option<usize> {
        self.count.checked_mul(self.fields().len())
    }
}

fn too_few(records: &[Record]) -> Problem {
    Problem::new(
        "data set 58 with fewer than 11 records",
        "export again: its head is not complete",
    )
    .at_line(records.first().map_or(1, |r| r.line))
}

fn unknown_type(code: i64, record: &Record) -> Problem {
    Problem::new(
        format!("ordinate type {code} is none of 2, 4, 5, 6"),
        "export real or complex values of 4 or 8 bytes",
    )
    .at_line(record.line)
}

fn negative(record: &Record) -> Problem {
    Problem::new(
        "negative number of values",
        "export again: record 7 is damaged",
    )
    .at_line(record.line)
}

/// Reads an ASCII block.
pub fn ascii(records: &[Record]) -> Outcome<Function> {
    let layout = Layout::parse(records)?;
    let data = records.get(11..).ok_or_else(|| too_few(records))?;
    let numbers = text_numbers(&layout, data).map_err(|p| p.at_line(records[6].line))?;
    let fields = layout.fields().len();
    let lead = usize::from(!layout.even);
    let rows = || numbers.chunks_exact(fields);
    let places = rows().flat_map(|row| row[..lead].iter().copied()).collect();
    let parts = rows().flat_map(|row| row[lead..].iter().copied()).collect();
    function(records, &layout, places, parts)
}

/// Reads a binary block.
pub fn binary(head: &binary::Head, payload: &[u8]) -> Outcome<Function> {
    let layout = Layout::parse(&head.records)?;
    let (places, parts) = binary::numbers(head, &layout, payload);
    let mut function = function(&head.records, &layout, places, parts)?;
    function.double = head.widths.1 == 8;
    Ok(function)
}

/// The numbers of the data records: as many as declared, no fewer, and no line more.
fn text_numbers(layout: &Layout, data: &[Record]) -> Outcome<Vec<f64>> {
    let wanted = layout.numbers().ok_or_else(|| short(layout, 0))?;
    let fields = layout.fields();
    let mut numbers = Vec::new();
    for record in data.iter().filter(|r| !r.bytes.trim_ascii().is_empty()) {
        if numbers.len() >= wanted {
            return Err(long(layout).at_line(record.line));
        }
        let place = numbers.len();
        push_fixed(record.bytes, &fields, place, wanted, &mut numbers)
            .or_else(|| push_spaced(record.bytes, place, wanted, &mut numbers))
            .ok_or_else(|| no_number(record))?;
    }
    if numbers.len() < wanted {
        return Err(short(layout, numbers.len() / fields.len()));
    }
    Ok(numbers)
}

/// Fields of fixed width, which may touch; blank fields end the line.
fn push_fixed(
    mut line: &[u8],
    fields: &[usize],
    place: usize,
    wanted: usize,
    numbers: &mut Vec<f64>,
) -> Option<()> {
    while numbers.len() < wanted && !line.trim_ascii().is_empty() {
        let width = fields[numbers.len() % fields.len()].min(line.len());
        let (field, rest) = line.split_at(width);
        let value = number(field);
        if value.is_none() {
            numbers.truncate(place);
        }
        numbers.push(value?);
        line = rest;
    }
    Some(())
}

/// Fields between blanks, where a writer did not keep to the columns.
fn push_spaced(line: &[u8], place: usize, wanted: usize, numbers: &mut Vec<f64>) -> Option<()> {
    let words = line
        .split(|b| b.is_ascii_whitespace())
        .filter(|w| !w.is_empty());
    let values: Option<Vec<f64>> = words.take(wanted - place).map(number).collect();
    numbers.extend(values?);
    Some(())
}

fn short(layout: &Layout, found: usize) -> Problem {
    Problem::new(
        format!("{} values are declared, {found} are there", layout.count),
        "export again, or correct the number in record 7 if the signal really ends here",
    )
}

fn long(layout: &Layout) -> Problem {
    Problem::new(
        format!("more values than the {} declared", layout.count),
        "export again, or correct the number in record 7",
    )
}

fn no_number(record: &Record) -> Problem {
    Problem::new(
        format!(
            "`{}` holds something that is not a number",
            record.text().trim()
        ),
        "export again: the data are damaged",
    )
    .at_line(record.line)
}

fn function(
    records: &[Record],
    layout: &Layout,
    places: Vec<f64>,
    parts: Vec<f64>,
) -> Outcome<Function> {
    if records.len() < 11 {
        return Err(too_few(records));
    }
    let names = &records[5];
    let abscissa = if layout.even {
        Abscissa::Even {
            start: layout.start,
            step: layout.step,
        }
    } else {
        Abscissa::Uneven(places)
    };
    Ok(Function {
        id: std::array::from_fn(|i| records[i].field(0, 80)),
        kind: Kind::of(names.integer(0, 5)?),
        numbers: [
            names.integer(5, 15)?,
            names.integer(15, 20)?,
            names.integer(20, 30)?,
        ],
        response: dof(names, 31)?,
        reference: dof(names, 56)?,
        abscissa,
        values: values(layout, parts),
        double: layout.double,
        z: layout.z,
        axes: [
            Axis::parse(&records[7])?,
            Axis::parse(&records[8])?,
            Axis::parse(&records[9])?,
            Axis::parse(&records[10])?,
        ],
    })
}

fn dof(record: &Record, from: usize) -> Outcome<Dof> {
    Ok(Dof {
        entity: record.field(from, from + 10),
        node: record.integer(from + 10, from + 20)?,
        direction: record.integer(from + 20, from + 24)?,
    })
}

fn values(layout: &Layout, parts: Vec<f64>) -> Values {
    if !layout.complex {
        return Values::Real(parts);
    }
    let pairs = parts.chunks_exact(2);
    Values::Complex(pairs.map(|p| Complex64::new(p[0], p[1])).collect())
}
