//! Data set 82: trace lines, the wires of a wireframe.

use super::blocks::cut_off;
use super::fields::{Record, number};
use crate::ground::problem::{Outcome, Problem};

/// A trace line.
#[derive(Debug, Clone, PartialEq)]
pub struct Trace {
    /// Its number.
    pub number: i64,
    /// Its name.
    pub name: String,
    /// Labels of its nodes in turn; 0 lifts the pen.
    pub nodes: Vec<i64>,
    /// Line of the file on which it begins.
    pub line: usize,
}

/// Width of a label in its record.
const WIDTH: usize = 10;

/// Reads the trace line of one data set.
pub fn parse(records: &[Record]) -> Outcome<Trace> {
    let [head, name, data @ ..] = records else {
        return Err(cut_off(records.first().map_or(1, |r| r.line)));
    };
    let wanted = head.integer(10, 20)?;
    let mut nodes = Vec::new();
    for record in data {
        nodes.extend(labels(record)?);
    }
    if usize::try_from(wanted).ok() != Some(nodes.len()) {
        return Err(Problem::new(
            format!(
                "a trace line of {wanted} nodes is declared, {} are there",
                nodes.len()
            ),
            "export the geometry again, or correct the number in the first record of data set 82",
        )
        .at_line(head.line));
    }
    Ok(Trace {
        number: head.integer(0, 10)?,
        name: name.field(0, 80),
        nodes,
        line: head.line,
    })
}

/// Labels in columns of ten, else between blanks.
fn labels(record: &Record) -> Outcome<Vec<i64>> {
    let text = record.text();
    let chars: Vec<char> = text.trim_end().chars().collect();
    let columns = chars
        .chunks(WIDTH)
        .map(|field| field.iter().collect::<String>());
    let columns: Option<Vec<i64>> = columns.map(|field| field.trim().parse().ok()).collect();
    let words = || text.split_whitespace().map(label).collect();
    columns.or_else(words).ok_or_else(|| {
        Problem::new(
            format!(
                "`{}` holds something that is no label of a node",
                text.trim()
            ),
            "export the geometry again",
        )
        .at_line(record.line)
    })
}

fn label(word: &str) -> Option<i64> {
    let value = number(word.as_bytes())?;
    let whole = value.fract() == 0.0 && value.abs() < 1e15;
    whole.then_some(value as i64)
}
