//! Data set 15: nodes.

use super::fields::Record;
use crate::ground::problem::Outcome;

/// A node.
#[derive(Debug, Clone, PartialEq)]
pub struct Node {
    /// Its label.
    pub label: i64,
    /// Definition coordinate system, displacement coordinate system, colour.
    pub systems: [i64; 3],
    /// Position, length unit of the file.
    pub position: [f64; 3],
}

/// Reads one node per record; blank lines are passed over.
pub fn parse(records: &[Record]) -> Outcome<Vec<Node>> {
    let filled = records.iter().filter(|r| !r.bytes.trim_ascii().is_empty());
    filled.map(node).collect()
}

fn node(record: &Record) -> Outcome<Node> {
    Ok(Node {
        label: record.integer(0, 10)?,
        systems: [
            record.integer(10, 20)?,
            record.integer(20, 30)?,
            record.integer(30, 40)?,
        ],
        position: [
            record.number(40, 53)?,
            record.number(53, 66)?,
            record.number(66, 79)?,
        ],
    })
}
