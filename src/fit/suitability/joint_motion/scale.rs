//! Units: twist per torque beside the nominal stiffness.

use super::{Moving, Rule};
use crate::fit::suitability::magnitude::{explanation, times};
use crate::fit::suitability::{Said, Weight};

/// A stiffness far from the nominal one is a unit or a gear ratio, not the joint.
pub const RULE: Rule = Rule {
    name: "scale",
    remedy: "check the units of torque and angles, the gear ratio and the nominal stiffness",
    look,
};

/// Ratio of stiffnesses that no joint shows.
const FAR: f64 = 8.0;
/// Share of the twist that torque must describe.
const SHARE: f64 = 0.5;

fn look(on: &Moving) -> Said {
    let Some(spring) = on
        .spring
        .as_ref()
        .filter(|s| s.share > SHARE && s.relative < 0.0)
    else {
        return Vec::new();
    };
    let ratio = -1.0 / spring.relative;
    if (1.0 / FAR..=FAR).contains(&ratio) {
        return Vec::new();
    }
    let why = explanation(ratio).map_or(String::new(), |why| format!("; {why}"));
    let what = format!(
        "the stiffness comes out {} the nominal one{why}",
        times(ratio)
    );
    vec![(Weight::Fatal, what)]
}
