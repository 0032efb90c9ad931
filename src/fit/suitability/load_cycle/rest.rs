//! The unloaded start that the file states.

use super::{Course, Rule};
use crate::fit::suitability::{Said, Weight};

/// The unloaded start fixes the zero of both channels.
pub const RULE: Rule = Rule {
    name: "rest",
    remedy: "correct `rest_s`, or the column of the load",
    look,
};

fn look(on: &Course) -> Said {
    let file = on.file;
    let first = on.cycles.first_loaded;
    let found = file.time[first] - file.time[0];
    let off = |stated: &f64| (stated - found).abs() > 0.5 * stated.max(1.0);
    let said = |stated: f64| {
        let what = format!("front matter states {stated} s of unloaded start, found {found:.2} s");
        (Weight::Note, what)
    };
    file.facts.rest.filter(off).map(said).into_iter().collect()
}
