//! Rows without a value.

use super::{Course, Rule};
use crate::fit::suitability::{Said, Weight};

/// A row without time, load or deflection is left out, and counted.
pub const RULE: Rule = Rule {
    name: "left-out",
    remedy: "fill the empty cells",
    look,
};

/// Share of rows beyond which what is left may not be the test.
const MANY: f64 = 0.2;

fn look(on: &Course) -> Said {
    let file = on.file;
    if file.left_out == 0 {
        return Vec::new();
    }
    let weight = match file.left_out as f64 > MANY * file.rows as f64 {
        true => Weight::Odd,
        false => Weight::Note,
    };
    let what = format!(
        "{} of {} rows left out for an empty cell",
        file.left_out, file.rows
    );
    vec![(weight, what)]
}
