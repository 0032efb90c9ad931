//! Signs: a structure gives way along the force.

use super::{Loaded, Rule, names, own};
use crate::fit::force_steps::Setup;
use crate::fit::suitability::{Said, Weight};
use crate::measurement::workspace_test::DIRECTIONS;

/// The tool gives way along the force, never against it.
pub const RULE: Rule = Rule {
    name: "reversed",
    remedy: "turn the sign of that channel or of the force (base frame)",
    look,
};

/// Standard errors beyond which a slope is negative.
const SURE: f64 = 4.0;

fn look(on: &Loaded) -> Said {
    let negative = |s: &&Setup| own(s).is_some_and(|(slope, stderr)| slope < -SURE * stderr);
    let mut found = Vec::new();
    for (d, direction) in DIRECTIONS.iter().enumerate() {
        let along = on
            .setups
            .iter()
            .filter(|s| s.direction == d && own(s).is_some());
        let wrong: Vec<&Setup> = along.clone().filter(negative).collect();
        let what = match wrong.len() {
            0 => continue,
            n if n == along.count() => format!(
                "the tool moves against every force along {direction}: the sign of d{direction} is wrong"
            ),
            _ => format!(
                "the tool moves against the force at {}",
                names(wrong.into_iter())
            ),
        };
        found.push((Weight::Fatal, what));
    }
    found
}
