//! Rows in the place of time.

use super::{Course, Rule};
use crate::fit::suitability::{Said, Weight, said_if};

/// Without time rows are taken as equally far apart, and no number in seconds follows.
pub const RULE: Rule = Rule {
    name: "counted",
    remedy: "record the time of every row",
    look,
};

fn look(on: &Course) -> Said {
    let what =
        "the file has no time: rows are taken as equally far apart, and nothing is told in seconds";
    said_if(on.file.counts_rows, Weight::Note, what)
}
