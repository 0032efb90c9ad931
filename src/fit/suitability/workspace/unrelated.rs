//! The displacement must depend on the force.

use super::{Loaded, Rule, names, own};
use crate::fit::force_steps::Setup;
use crate::fit::suitability::{Said, Weight};
use crate::measurement::workspace_test::DIRECTIONS;

/// Displacement that does not follow the force is noise, or another channel.
pub const RULE: Rule = Rule {
    name: "unrelated",
    remedy: "check which sensor was recorded in this column",
    look,
};

/// Standard errors beyond which a slope is not zero.
const SURE: f64 = 4.0;

fn look(on: &Loaded) -> Said {
    let mut found = Vec::new();
    for (d, direction) in DIRECTIONS.iter().enumerate() {
        let along: Vec<&Setup> = on
            .setups
            .iter()
            .filter(|s| s.direction == d && own(s).is_some())
            .collect();
        let follows =
            |s: &&&Setup| own(s).is_some_and(|(slope, stderr)| slope.abs() > SURE * stderr);
        let lost: Vec<&Setup> = along.iter().filter(|s| !follows(s)).copied().collect();
        let (what, weight) = match (lost.len(), along.len()) {
            (0, _) => continue,
            (n, all) if 2 * n > all => (
                format!(
                    "d{direction} does not follow the force along {direction} beyond chance at {n} of {all} points"
                ),
                Weight::Fatal,
            ),
            _ => (
                format!(
                    "the displacement does not follow the force beyond chance at {}",
                    names(lost.into_iter())
                ),
                Weight::Odd,
            ),
        };
        found.push((weight, what));
    }
    found
}
