//! A cycle must be resolved.

use super::{Course, Rule};
use crate::fit::suitability::{Said, Weight, said_if};

/// Shape and noise of a ramp need readings on it.
pub const RULE: Rule = Rule {
    name: "few-rows",
    remedy: "sample faster, or load more slowly",
    look,
};

/// Fewer readings than this tell no spring from chance.
const FEWEST: usize = 16;
/// Fewer readings on a ramp than this.
const ON_A_RAMP: usize = 4;

fn look(on: &Course) -> Said {
    let file = on.file;
    let rows = file.load.len();
    let ramps = on.cycles.turning.len() + 1;
    if rows < FEWEST {
        return vec![(Weight::Fatal, format!("there are only {rows} usable rows"))];
    }
    said_if(
        ramps > 2 && rows / ramps < ON_A_RAMP,
        Weight::Fatal,
        format!(
            "{rows} rows hold {ramps} ramps of the load: fewer than {ON_A_RAMP} readings on each"
        ),
    )
}
