//! Segments of a TDMS file: what they say of the objects, and their raw data.

use super::super::bytes::{Bytes, Number, cut};
use crate::ground::problem::{Outcome, Problem};

/// Bits of the table of contents.
const META: u32 = 1 << 1;
const NEW_LIST: u32 = 1 << 2;
const RAW: u32 = 1 << 3;
const INTERLEAVED: u32 = 1 << 5;
const BIG: u32 = 1 << 6;
const DAQMX: u32 = 1 << 7;
/// Lengths of raw data indices that are none.
const NO_DATA: u32 = u32::MAX;
const AS_BEFORE: u32 = 0;
/// Bytes of a lead-in.
const LEAD: usize = 28;
/// A time stamp: fractions of 2⁻⁶⁴ s, then seconds since 1904.
const TIMESTAMP: u32 = 0x44;
const STRING: u32 = 0x20;

/// A file, group or channel.
#[derive(Debug, Default)]
pub(super) struct Object {
    pub(super) path: String,
    pub(super) properties: Vec<(String, Property)>,
    pub(super) values: Vec<f64>,
    index: Option<Index>,
    /// Seconds of the first time stamp: the others count from it.
    epoch: Option<i64>,
}

/// A property's value.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Property {
    Text(String),
    Number(f64),
    Other,
}

impl Property {
    pub(super) fn text(&self) -> String {
        match self {
            Self::Text(text) => text.clone(),
            _ => String::new(),
        }
    }

    pub(super) fn number(&self) -> Option<f64> {
        match self {
            Self::Number(number) => Some(*number),
            _ => None,
        }
    }
}

/// What a channel writes into each chunk.
#[derive(Debug, Clone, Copy)]
struct Index {
    kind: u32,
    count: usize,
    /// Bytes of one chunk.
    bytes: usize,
}

/// The segments that are left, and what is known so far.
pub(super) struct Segments<'a> {
    left: &'a [u8],
    pub(super) objects: Vec<Object>,
    /// Indices of the objects that write, in their order.
    list: Vec<usize>,
}

impl<'a> Segments<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self {
            left: bytes,
            objects: Vec::new(),
            list: Vec::new(),
        }
    }

    /// Takes the next segment; false after the last one.
    pub(super) fn advance(&mut self) -> Outcome<bool> {
        if self.left.is_empty() {
            return Ok(false);
        }
        let mut lead = Bytes::new(self.left, false);
        if lead.take(4)? != b"TDSm" {
            return Err(cut());
        }
        let contents = lead.u32()?;
        lead.big = contents & BIG != 0;
        lead.u32()?;
        let (next, raw) = (lead.u64()?, lead.u64()?);
        // A segment that was being written when the program ended says so by its length.
        let body = lead.take(next.min(lead.left() as u64) as usize)?;
        let mut meta = Bytes::new(body, lead.big);
        let raw = usize::try_from(raw).ok().filter(|raw| *raw <= body.len());
        let raw = raw.ok_or_else(cut)?;
        if contents & META != 0 {
            self.meta(&mut meta, contents & NEW_LIST != 0)?;
        }
        if contents & RAW != 0 {
            if contents & DAQMX != 0 {
                return Err(daqmx());
            }
            let data = Bytes::new(&body[raw..], lead.big);
            self.raw(data, contents & INTERLEAVED != 0)?;
        }
        self.left = &self.left[LEAD + body.len()..];
        Ok(true)
    }

    fn meta(&mut self, meta: &mut Bytes, new_list: bool) -> Outcome<()> {
        if new_list {
            self.list.clear();
        }
        for _ in 0..meta.u32()? {
            let path = text(meta)?;
            let known = self.objects.iter().position(|object| object.path == path);
            let at = known.unwrap_or_else(|| {
                self.objects.push(Object {
                    path,
                    ..Object::default()
                });
                self.objects.len() - 1
            });
            let writes = match meta.u32()? {
                NO_DATA => false,
                AS_BEFORE => self.objects[at].index.is_some(),
                0x6912_0000 | 0x6913_0000 | 0x1269_0000 | 0x1369_0000 => return Err(daqmx()),
                _ => {
                    self.objects[at].index = Some(index(meta)?);
                    true
                }
            };
            self.list
                .retain(|other| *other != at || (writes && !new_list));
            if writes && !self.list.contains(&at) {
                self.list.push(at);
            }
            for _ in 0..meta.u32()? {
                let (name, value) = (text(meta)?, property(meta)?);
                let own = &mut self.objects[at].properties;
                own.retain(|p| p.0 != name);
                own.push((name, value));
            }
        }
        Ok(())
    }

    /// As many chunks as there are; the last one may be cut.
    fn raw(&mut self, mut data: Bytes, interleaved: bool) -> Outcome<()> {
        let indices: Vec<(usize, Index)> = self
            .list
            .iter()
            .filter_map(|at| Some((*at, self.objects[*at].index?)))
            .collect();
        let bytes = indices.iter().map(|(_, index)| index.bytes);
        let chunk = bytes.fold(0, usize::saturating_add);
        if chunk == 0 {
            return Ok(());
        }
        let rows = indices.first().map_or(0, |(_, index)| index.count);
        if interleaved && indices.iter().any(|(_, index)| index.count != rows) {
            return Err(cut());
        }
        while data.left() >= chunk {
            match interleaved {
                false => {
                    for (at, index) in &indices {
                        let own = data.take(index.bytes)?;
                        self.objects[*at].fill(own, index, data.big)?;
                    }
                }
                true => {
                    for (at, index) in indices.iter().cycle().take(rows * indices.len()) {
                        let one = Index {
                            count: 1,
                            bytes: size(index.kind).ok_or_else(cut)?,
                            ..*index
                        };
                        let own = data.take(one.bytes)?;
                        self.objects[*at].fill(own, &one, data.big)?;
                    }
                }
            }
        }
        Ok(())
    }
}

impl Object {
    /// The value of a property.
    pub(super) fn property(&self, key: &str) -> Option<&Property> {
        let found = self.properties.iter().find(|property| property.0 == key);
        found.map(|property| &property.1)
    }

    /// Takes the numbers of a chunk; texts are passed over.
    fn fill(&mut self, bytes: &[u8], index: &Index, big: bool) -> Outcome<()> {
        if index.kind == TIMESTAMP {
            for stamp in bytes.chunks_exact(16) {
                let value = self.since_first(stamp, big);
                self.values.push(value);
            }
            return Ok(());
        }
        let Some(kind) = number(index.kind) else {
            return Ok(());
        };
        let all = bytes.chunks_exact(kind.size());
        self.values.extend(all.map(|one| kind.of(one, big)));
        Ok(())
    }

    /// Seconds since the first stamp: whole since 1904 they would not hold microseconds.
    fn since_first(&mut self, stamp: &[u8], big: bool) -> f64 {
        let (fraction, seconds) = match big {
            true => (&stamp[8..], &stamp[..8]),
            false => (&stamp[..8], &stamp[8..]),
        };
        let seconds = Number::Signed(8).of(seconds, big) as i64;
        let first = *self.epoch.get_or_insert(seconds);
        seconds.saturating_sub(first) as f64
            + Number::Unsigned(8).of(fraction, big) / 2.0_f64.powi(64)
    }
}

fn index(meta: &mut Bytes) -> Outcome<Index> {
    let (kind, dimension, count) = (meta.u32()?, meta.u32()?, meta.u64()?);
    let count = usize::try_from(count).ok().filter(|_| dimension == 1);
    let count = count.ok_or_else(cut)?;
    let bytes = match kind {
        STRING => usize::try_from(meta.u64()?).ok(),
        kind => size(kind).and_then(|size| size.checked_mul(count)),
    };
    let bytes = bytes.ok_or_else(|| {
        let what = format!("holds values of the type 0x{kind:x}, which are not known here");
        Problem::new(what, "write floating-point or whole numbers")
    })?;
    Ok(Index { kind, count, bytes })
}

fn number(kind: u32) -> Option<Number> {
    Some(match kind {
        1..=4 => Number::Signed(1 << (kind - 1)),
        5..=8 => Number::Unsigned(1 << (kind - 5)),
        9 | 0x19 => Number::Float(4),
        10 | 0x1A => Number::Float(8),
        0x21 => Number::Unsigned(1),
        _ => return None,
    })
}

/// Bytes of a value.
fn size(kind: u32) -> Option<usize> {
    match kind {
        TIMESTAMP => Some(16),
        kind => number(kind).map(Number::size),
    }
}

fn text(meta: &mut Bytes) -> Outcome<String> {
    let length = meta.count()?;
    Ok(String::from_utf8_lossy(meta.take(length)?).to_string())
}

fn property(meta: &mut Bytes) -> Outcome<Property> {
    match meta.u32()? {
        STRING => Ok(Property::Text(text(meta)?)),
        kind => {
            let size = size(kind).ok_or_else(cut)?;
            let bytes = meta.take(size)?;
            let value = number(kind).map(|kind| Property::Number(kind.of(bytes, meta.big)));
            Ok(value.unwrap_or(Property::Other))
        }
    }
}

fn daqmx() -> Problem {
    Problem::new(
        "holds raw data of DAQmx, scaled by its driver",
        "let LabVIEW write scaled channels, or export the file as text",
    )
}
