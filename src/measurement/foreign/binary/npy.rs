//! Arrays of NumPy (`.npy`, NEP 1): two dimensions, or one of a structured type.

use super::Sheet;
use super::bytes::{Bytes, Number, cut};
use super::grid::{Column, sheets};
use crate::ground::problem::{Outcome, Problem};

const MAGIC: &[u8] = b"\x93NUMPY";

pub(super) fn recognises(bytes: &[u8]) -> bool {
    bytes.starts_with(MAGIC)
}

/// Columns of a table at most.
const MOST: usize = 10_000;

/// How an element is stored, and whether its first byte is the highest.
type Stored = (Number, bool);

pub(super) fn read(bytes: &[u8]) -> Outcome<Vec<Sheet>> {
    let mut left = Bytes::new(bytes, false);
    let head = left.take(8)?;
    let length = match head[6] {
        1 => left.number(Number::Unsigned(2))? as usize,
        _ => left.count()?,
    };
    let head = String::from_utf8_lossy(left.take(length)?).to_string();
    let shape = shape(&head)?;
    let fields = fields(&head)?;
    let columns = match (fields.as_slice(), shape.as_slice()) {
        ([(None, stored)], [rows, columns]) if *columns <= MOST => {
            let by_column = value_of(&head, "fortran_order").is_some_and(|v| v.starts_with("True"));
            plain(left, *stored, [*rows, *columns], by_column)?
        }
        ([(Some(_), _), ..], [rows]) => structured(left, &fields, *rows)?,
        _ => return Err(not_a_table()),
    };
    Ok(sheets("array", columns))
}

fn not_a_table() -> Problem {
    Problem::new(
        "is no array of two dimensions, nor one of a structured type",
        "save rows by columns: numpy.save(file, numpy.column_stack([time, force, ...]))",
    )
}

fn plain(
    mut left: Bytes,
    (kind, big): Stored,
    [rows, columns]: [usize; 2],
    by_column: bool,
) -> Outcome<Vec<Column>> {
    left.big = big;
    let count = rows
        .checked_mul(columns)
        .and_then(|n| n.checked_mul(kind.size()));
    if count.is_none_or(|bytes| bytes > left.left()) {
        return Err(cut());
    }
    let mut all: Vec<Column> = (1..=columns)
        .map(|k| Column {
            title: format!("column {k}"),
            values: Vec::with_capacity(rows),
        })
        .collect();
    for k in 0..rows * columns {
        let column = if by_column { k / rows } else { k % columns };
        all[column].values.push(left.number(kind)?);
    }
    Ok(all)
}

fn structured(
    mut left: Bytes,
    fields: &[(Option<String>, Stored)],
    rows: usize,
) -> Outcome<Vec<Column>> {
    let column = |(name, _): &(Option<String>, Stored)| Column {
        title: name.clone().unwrap_or_default(),
        values: Vec::new(),
    };
    let mut all: Vec<Column> = fields.iter().map(column).collect();
    for _ in 0..rows {
        for (column, (_, (kind, big))) in all.iter_mut().zip(fields) {
            left.big = *big;
            column.values.push(left.number(*kind)?);
        }
    }
    Ok(all)
}

/// What stands behind a key of the dictionary in the head.
fn value_of<'a>(head: &'a str, key: &str) -> Option<&'a str> {
    let quoted = [format!("'{key}'"), format!("\"{key}\"")];
    let behind = quoted
        .iter()
        .find_map(|key| head.split_once(key.as_str()))?
        .1;
    Some(behind.trim_start().strip_prefix(':')?.trim_start())
}

fn shape(head: &str) -> Outcome<Vec<usize>> {
    let inside = value_of(head, "shape").and_then(|v| v.strip_prefix('('));
    let inside = inside.and_then(|v| v.split_once(')')).ok_or_else(cut)?.0;
    let numbers = inside.split(',').map(str::trim).filter(|n| !n.is_empty());
    numbers.map(|n| n.parse().map_err(|_| cut())).collect()
}

/// Names and types of the fields; one without a name where the type is plain.
fn fields(head: &str) -> Outcome<Vec<(Option<String>, Stored)>> {
    let descr = value_of(head, "descr").ok_or_else(cut)?;
    let (words, plain) = words(descr);
    if !descr.starts_with('[') {
        return Ok(vec![(None, stored(words.first().ok_or_else(cut)?)?)]);
    }
    // a type of its own for a field, or more than one value in it
    if words.len() % 2 != 0 || plain.contains("[[") || plain.contains(|c: char| c.is_ascii_digit())
    {
        return Err(not_a_table());
    }
    let pairs = words.chunks_exact(2);
    pairs
        .map(|pair| Ok((Some(pair[0].clone()), stored(&pair[1])?)))
        .collect()
}

/// The texts in quotes up to the end of a list (of the first text, if there is none), and what stands
/// between them.
fn words(text: &str) -> (Vec<String>, String) {
    let list = text.starts_with('[');
    let (mut words, mut plain) = (Vec::new(), String::new());
    let mut open: Option<(char, String)> = None;
    for c in text.chars() {
        match &mut open {
            Some((quote, word)) if c == *quote => {
                words.push(std::mem::take(word));
                open = None;
                if !list {
                    break;
                }
            }
            Some((_, word)) => word.push(c),
            None if c == '\'' || c == '"' => open = Some((c, String::new())),
            None if c == ']' => break,
            None => plain.push(c),
        }
    }
    (words, plain)
}

/// `<f8`, `>i2`, `|u1`.
fn stored(text: &str) -> Outcome<Stored> {
    let refused = || {
        let what = format!("holds values of the type `{text}`, which are no numbers known here");
        Problem::new(what, "save floating-point or whole numbers (float64)")
    };
    let big = text.starts_with('>');
    let kind = text.trim_start_matches(['<', '>', '|', '=']);
    let size: usize = kind
        .get(1..)
        .and_then(|n| n.parse().ok())
        .ok_or_else(refused)?;
    let known = |sizes: &[usize]| sizes.contains(&size);
    match kind.chars().next() {
        Some('f') if known(&[4, 8]) => Ok((Number::Float(size), big)),
        Some('i') if known(&[1, 2, 4, 8]) => Ok((Number::Signed(size), big)),
        Some('u' | 'b') if known(&[1, 2, 4, 8]) => Ok((Number::Unsigned(size), big)),
        _ => Err(refused()),
    }
}
