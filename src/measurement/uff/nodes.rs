//! Data sets 15 and 2411: nodes.

use super::blocks::cut_off;
use super::fields::Record;
use crate::ground::problem::{Outcome, Problem};

/// A node.
#[derive(Debug, Clone, PartialEq)]
pub struct Node {
    /// Its label.
    pub label: i64,
    /// Definition coordinate system, displacement coordinate system, colour.
    pub systems: [i64; 3],
    /// Position, length unit of the file.
    pub position: [f64; 3],
    /// Line of the file on which it begins.
    pub line: usize,
}

/// Reads one node per record (data set 15); blank lines are passed over.
pub fn parse(records: &[Record]) -> Outcome<Vec<Node>> {
    filled(records).map(node).collect()
}

/// Reads one node per two records (data set 2411): label and systems, then its place.
pub fn parse_double(records: &[Record]) -> Outcome<Vec<Node>> {
    let all: Vec<&Record> = filled(records).collect();
    all.chunks(2).map(pair).collect()
}

fn filled<'a, 'b>(records: &'a [Record<'b>]) -> impl Iterator<Item = &'a Record<'b>> {
    records.iter().filter(|r| !r.bytes.trim_ascii().is_empty())
}

fn pair(pair: &[&Record]) -> Outcome<Node> {
    let [head, place] = pair else {
        return Err(cut_off(pair[0].line));
    };
    finite(Node {
        label: head.integer(0, 10)?,
        systems: [
            head.integer(10, 20)?,
            head.integer(20, 30)?,
            head.integer(30, 40)?,
        ],
        position: [
            place.number(0, 25)?,
            place.number(25, 50)?,
            place.number(50, 75)?,
        ],
        line: head.line,
    })
}

fn finite(node: Node) -> Outcome<Node> {
    match node.position.iter().all(|x| x.is_finite()) {
        true => Ok(node),
        false => Err(Problem::new(
            format!("the place of node {} is not finite", node.label),
            "export the geometry again",
        )
        .at_line(node.line)),
    }
}

fn node(record: &Record) -> Outcome<Node> {
    finite(Node {
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
        line: record.line,
    })
}
