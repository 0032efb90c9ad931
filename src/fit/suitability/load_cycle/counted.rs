//! Rows in the place of time.

use super::{Course, Rule};
use crate::fit::suitability::{Said, Weight, said_if};

/// Without time rows are taken as one second apart: whatever is told in seconds counts rows.
pub const RULE: Rule = Rule {
    name: "counted",
    remedy: "record the time of every row",
    look,
};

fn look(on: &Course) -> Said {
    let what = "the file has no time: rows are taken as one second apart, and no time that a fit tells is one";
    said_if(on.file.counts_rows, Weight::Note, what)
}
