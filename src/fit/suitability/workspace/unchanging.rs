//! The force must change.

use super::{Loaded, Rule, names};
use crate::fit::suitability::{Said, Weight, extent, said_if};
use crate::ground::stats::largest;

/// Without a change of force there is no stiffness.
pub const RULE: Rule = Rule {
    name: "unchanging",
    remedy: "check the channel of the force, and measure again",
    look,
};

fn look(on: &Loaded) -> Said {
    let force: Vec<f64> = on.test.steps.iter().map(|s| s.force).collect();
    if extent(&force) <= 1e-12 * largest(&force) {
        return vec![(Weight::Fatal, "the force never changes".into())];
    }
    let none = |s: &&crate::fit::force_steps::Setup| s.lines.iter().all(Option::is_none);
    if on.setups.iter().all(|s| none(&s)) {
        return vec![(Weight::Fatal, "no set-up holds a change of force".into())];
    }
    said_if(
        on.setups.iter().any(|s| none(&s)),
        Weight::Odd,
        format!(
            "no change of force gives a line at {}",
            names(on.setups.iter().filter(none))
        ),
    )
}
