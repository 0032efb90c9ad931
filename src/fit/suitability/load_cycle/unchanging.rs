//! Load and response must change.

use super::{Course, Rule};
use crate::fit::suitability::{Said, Weight, extent};
use crate::ground::stats::largest;

/// A load or a response that stays the same says nothing of a spring.
pub const RULE: Rule = Rule {
    name: "unchanging",
    remedy: "check cable and channel, and measure again",
    look,
};

/// Changes below this share of the channel's level are rounding.
const ROUNDING: f64 = 1e-12;

fn look(on: &Course) -> Said {
    let file = on.file;
    let still = |values: &[f64]| {
        let level = largest(values);
        extent(values) <= ROUNDING * level
    };
    let mut found = Vec::new();
    if still(&file.load) {
        found.push((Weight::Fatal, "the load never changes".into()));
    }
    if still(&file.deflection) {
        found.push((Weight::Fatal, "the deflection never changes".into()));
    }
    if file.second.as_deref().is_some_and(still) {
        found.push((Weight::Odd, "the second deflection never changes".into()));
    }
    found
}
