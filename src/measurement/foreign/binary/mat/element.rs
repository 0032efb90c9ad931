//! Data elements of a MAT file.

use super::super::bytes::{Bytes, Number, cut};
use crate::ground::problem::Outcome;
use flate2::read::ZlibDecoder;
use std::io::Read;

/// A variable with numbers, or a structure of such.
#[derive(Debug, Default)]
pub(super) struct Array {
    pub(super) name: String,
    pub(super) size: [usize; 2],
    /// Column by column.
    pub(super) values: Vec<f64>,
    /// Fields of a structure of one element.
    pub(super) fields: Vec<Array>,
}

/// Types of elements.
const MATRIX: u32 = 14;
const COMPRESSED: u32 = 15;
/// Classes of arrays.
const STRUCTURE: u8 = 2;
const NUMERIC: std::ops::RangeInclusive<u8> = 6..=15;
/// How deep structures may stand in structures.
const DEEPEST: usize = 8;
/// A compressed variable unpacks to at most this, bytes.
const LARGEST: u64 = 2 << 30;

/// All variables of a stretch of bytes.
pub(super) fn elements(bytes: &[u8], big: bool, depth: usize, all: &mut Vec<Array>) -> Outcome<()> {
    let mut left = Bytes::new(bytes, big);
    while left.left() >= 8 {
        let (kind, data) = element(&mut left)?;
        match kind {
            COMPRESSED if depth == 0 => {
                let mut unpacked = Vec::new();
                let packed = ZlibDecoder::new(data)
                    .take(LARGEST)
                    .read_to_end(&mut unpacked);
                packed.map_err(|_| cut())?;
                elements(&unpacked, big, depth + 1, all)?;
            }
            MATRIX => all.extend(array(data, big, depth)?),
            _ => {}
        }
    }
    Ok(())
}

/// The next element: its type and its data.
fn element<'a>(left: &mut Bytes<'a>) -> Outcome<(u32, &'a [u8])> {
    let tag = left.u32()?;
    if tag >> 16 != 0 {
        let (kind, size) = (tag & 0xFFFF, (tag >> 16) as usize);
        let data = left.take(4)?;
        return Ok((kind, data.get(..size).ok_or_else(cut)?));
    }
    let size = left.u32()? as usize;
    let data = left.take(size)?;
    if tag != COMPRESSED {
        let padding = (8 - size % 8) % 8;
        left.take(padding.min(left.left()))?;
    }
    Ok((tag, data))
}

/// A matrix element; `None` for texts, cells, sparse and complex arrays and such of more dimensions.
fn array(data: &[u8], big: bool, depth: usize) -> Outcome<Option<Array>> {
    if data.is_empty() {
        return Ok(None);
    }
    let mut left = Bytes::new(data, big);
    let (_, flags) = element(&mut left)?;
    let flags = Number::Unsigned(4).of(flags.get(..4).ok_or_else(cut)?, big) as u32;
    let (class, complex) = (flags as u8, flags & 0x0800 != 0);
    let (_, sizes) = element(&mut left)?;
    let sizes: Vec<usize> = sizes
        .chunks_exact(4)
        .map(|size| Number::Unsigned(4).of(size, big) as usize)
        .collect();
    let (_, name) = element(&mut left)?;
    let mut array = Array {
        name: String::from_utf8_lossy(name).to_string(),
        ..Array::default()
    };
    let [rows, columns] = sizes[..] else {
        return Ok(None);
    };
    array.size = [rows, columns];
    match class {
        STRUCTURE if array.size == [1, 1] && depth < DEEPEST => {
            array.fields = fields(&mut left, big, depth)?;
        }
        class if NUMERIC.contains(&class) && !complex => {
            let (kind, data) = element(&mut left)?;
            let Some(kind) = number(kind) else {
                return Ok(None);
            };
            let all = data.chunks_exact(kind.size());
            array.values = all.map(|one| kind.of(one, big)).collect();
        }
        _ => return Ok(None),
    }
    Ok(Some(array))
}

fn fields(left: &mut Bytes, big: bool, depth: usize) -> Outcome<Vec<Array>> {
    let (_, length) = element(left)?;
    let length = Number::Unsigned(4).of(length.get(..4).ok_or_else(cut)?, big) as usize;
    let (_, names) = element(left)?;
    let mut all = Vec::new();
    for name in names.chunks_exact(length.max(1)) {
        let (kind, data) = element(left)?;
        let found = match kind {
            MATRIX => array(data, big, depth + 1)?,
            _ => None,
        };
        let end = name.iter().position(|byte| *byte == 0).unwrap_or(length);
        let name = String::from_utf8_lossy(&name[..end]).to_string();
        all.extend(found.map(|array| Array { name, ..array }));
    }
    Ok(all)
}

/// How the numbers of a type of elements are stored.
fn number(kind: u32) -> Option<Number> {
    Some(match kind {
        1 => Number::Signed(1),
        2 => Number::Unsigned(1),
        3 => Number::Signed(2),
        4 => Number::Unsigned(2),
        5 => Number::Signed(4),
        6 => Number::Unsigned(4),
        7 => Number::Float(4),
        9 => Number::Float(8),
        12 => Number::Signed(8),
        13 => Number::Unsigned(8),
        _ => return None,
    })
}
