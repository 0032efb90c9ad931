//! Universal files: data set 58 (ASCII and binary), 151, 164, 15, 2411 and 82, read tolerantly and written
//! to the letter of the SDRC text.
//!
//! A file is a row of blocks between `    -1` lines; a block is a type line and records. Unknown
//! types are skipped and counted; a block that is cut off or contradicts itself is refused.

mod axis;
mod binary;
mod blocks;
mod fields;
mod function;
mod header;
mod nodes;
mod read;
mod traces;
mod units;
mod write;

pub use axis::{Axis, Quantity};
pub use function::{Abscissa, Dof, Function, Kind, Values};
pub use header::Header;
pub use nodes::Node;
pub use traces::Trace;
pub use units::Units;
pub use write::{Encoding, write};

use crate::ground::files;
use crate::ground::problem::Outcome;
use blocks::{Block, Lines};
use std::collections::BTreeMap;
use std::path::Path;

/// What a universal file holds.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct UniversalFile {
    /// Data set 151.
    pub header: Option<Header>,
    /// Data set 164. Without it the numbers are taken as SI, and the user is told so.
    pub units: Option<Units>,
    /// Data sets 15 and 2411.
    pub nodes: Vec<Node>,
    /// Data sets 82.
    pub traces: Vec<Trace>,
    /// Data sets 58, in the units of the file.
    pub functions: Vec<Function>,
    /// The line on which each of them begins.
    pub lines: Vec<usize>,
    /// Number of blocks skipped, by data set.
    pub skipped: BTreeMap<u32, usize>,
}

/// Reads a universal file.
pub fn read(path: &Path) -> Outcome<UniversalFile> {
    parse(&files::read_bytes(path)?).map_err(|problem| problem.in_text(path))
}

/// Reads the bytes of a universal file.
pub fn parse(bytes: &[u8]) -> Outcome<UniversalFile> {
    let mut lines = Lines::new(bytes);
    let mut file = UniversalFile::default();
    let mut blocks = 0;
    while let Some(block) = blocks::next(&mut lines)? {
        file.take(block)?;
        blocks += 1;
    }
    if blocks == 0 {
        return Err(crate::ground::problem::Problem::new(
            "not a universal file: no block between `    -1` lines",
            "export as universal file, data set 58",
        ));
    }
    Ok(file)
}

/// The line of the first record.
fn first(records: &[fields::Record]) -> usize {
    records.first().map_or(1, |record| record.line)
}

impl UniversalFile {
    fn take(&mut self, block: Block) -> Outcome<()> {
        match block {
            Block::Binary(head, payload) => {
                self.lines.push(first(&head.records));
                self.functions.push(read::binary(&head, payload)?);
            }
            Block::Text { set: 58, records } => {
                self.lines.push(first(&records));
                self.functions.push(read::ascii(&records)?);
            }
            Block::Text { set: 151, records } => self.header = Some(header::parse(&records)),
            Block::Text { set: 164, records } => self.units = Some(units::parse(&records)?),
            Block::Text { set: 15, records } => self.nodes.extend(nodes::parse(&records)?),
            Block::Text { set: 2411, records } => self.nodes.extend(nodes::parse_double(&records)?),
            Block::Text { set: 82, records } => self.traces.push(traces::parse(&records)?),
            Block::Text { set, .. } => *self.skipped.entry(set).or_default() += 1,
        }
        Ok(())
    }

    /// The functions in SI: `SI = value / factor` of data set 164 (as they are without one).
    pub fn functions_si(&self) -> Vec<Function> {
        let units = self.units.clone().unwrap_or_default();
        self.functions.iter().map(|f| units.to_si(f)).collect()
    }
}
