//! The bytes of data set 58b.

use super::blocks::{Block, Lines, cut_off, is_marker};
use super::fields::Record;
use super::read::Layout;
use crate::ground::problem::{Outcome, Problem};

/// Records before the bytes.
const RECORDS: usize = 11;

/// Type line and records of a binary block.
pub struct Head<'a> {
    /// Records 1 to 11.
    pub records: Vec<Record<'a>>,
    /// Whether the first byte is the highest.
    pub big_endian: bool,
    /// Bytes of an abscissa value and of an ordinate value, as found.
    pub widths: (usize, usize),
}

/// Takes a binary block after its type line.
pub fn take<'a>(lines: &mut Lines<'a>, kind: Record<'a>) -> Outcome<Block<'a>> {
    if kind.integer(0, 6)? != 58 {
        return Err(refuse(
            &kind,
            "binary data set other than 58",
            "export data set 58",
        ));
    }
    if kind.integer(13, 19)? != 2 {
        let what = "floating point format other than IEEE 754";
        return Err(refuse(
            &kind,
            what,
            "export with IEEE 754 numbers, or as ASCII",
        ));
    }
    let order = kind.integer(7, 13)?;
    if order != 1 && order != 2 {
        return Err(refuse(
            &kind,
            "unknown byte order",
            "export again: 1 is little, 2 big endian",
        ));
    }
    let declared = kind.integer(31, 43)?;
    let count = usize::try_from(kind.integer(19, 31)?).unwrap_or(RECORDS);
    let mut records = Vec::new();
    for _ in 0..count.clamp(RECORDS, 99) {
        records.push(lines.next().ok_or_else(|| cut_off(kind.line))?);
    }
    let layout = Layout::parse(&records)?;
    let (size, widths) = size(&layout, declared, lines.rest()).ok_or_else(|| wrong_size(&kind))?;
    let payload = &lines.rest()[..size];
    lines.pass(size);
    close(lines);
    let head = Head {
        records,
        big_endian: order == 2,
        widths,
    };
    Ok(Block::Binary(head, payload))
}

/// Passes over the closing marker, which [`size`] has seen.
fn close(lines: &mut Lines) {
    while lines.next().is_some_and(|line| !is_marker(line.bytes)) {}
}

/// Size of the payload and the bytes per abscissa and ordinate value. The declared count is believed
/// if it fits the records and a marker follows; else the size that the records ask for and that a
/// marker follows. Last come doubles that are labelled single (pyuff). Nothing is searched for.
fn size(layout: &Layout, declared: i64, rest: &[u8]) -> Option<(usize, (usize, usize))> {
    let fits = |widths: &(usize, usize)| {
        let size = layout
            .count
            .checked_mul(widths.0 + widths.1 * layout.parts())?;
        let closed = rest.get(size..).is_some_and(marker_follows);
        closed.then_some((size, *widths))
    };
    let found: Vec<_> = layout.widths().iter().filter_map(fits).collect();
    let believed = found
        .iter()
        .find(|(size, _)| i64::try_from(*size) == Ok(declared));
    believed.or(found.first()).copied()
}

fn marker_follows(rest: &[u8]) -> bool {
    let rest = rest.strip_prefix(b"\r").unwrap_or(rest);
    let rest = rest.strip_prefix(b"\n").unwrap_or(rest);
    let line = rest.split(|b| *b == b'\n').next().unwrap_or(rest);
    is_marker(line)
}

fn refuse(record: &Record, what: &str, remedy: &str) -> Problem {
    Problem::new(what, remedy).at_line(record.line)
}

fn wrong_size(kind: &Record) -> Problem {
    refuse(
        kind,
        "no number of bytes that fits the records is followed by the end of the data set",
        "copy or export the file again (binary transfer): it was cut off or changed",
    )
}

/// The numbers of a payload: abscissa (if stored) and ordinate parts, value by value.
pub fn numbers(head: &Head, layout: &Layout, payload: &[u8]) -> (Vec<f64>, Vec<f64>) {
    let (x, y) = head.widths;
    let mut places = Vec::new();
    let mut parts = Vec::new();
    for row in payload.chunks_exact((x + y * layout.parts()).max(1)) {
        let (place, values) = row.split_at(x);
        places.extend(
            place
                .chunks_exact(x.max(1))
                .map(|b| float(b, head.big_endian)),
        );
        parts.extend(values.chunks_exact(y).map(|b| float(b, head.big_endian)));
    }
    (places, parts)
}

fn float(bytes: &[u8], big_endian: bool) -> f64 {
    if let Ok(four) = <[u8; 4]>::try_from(bytes) {
        return f64::from(if big_endian {
            f32::from_be_bytes(four)
        } else {
            f32::from_le_bytes(four)
        });
    }
    let eight = <[u8; 8]>::try_from(bytes).unwrap_or_default();
    if big_endian {
        f64::from_be_bytes(eight)
    } else {
        f64::from_le_bytes(eight)
    }
}
