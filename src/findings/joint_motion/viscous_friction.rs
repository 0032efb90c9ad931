//! Friction in proportion to the speed, between motor and spring.

use super::joint::Joint;
use crate::findings::engine::Member;
use crate::findings::table::{Effect, Place};

/// As the engine takes it: one amount is twist per speed, s.
pub(super) const EFFECT: Effect<Joint> = Effect {
    name: "viscous_friction",
    summary: "Friction in proportion to the speed takes torque that never reaches the link.",
    mechanism: "viscous friction",
    law_error: 0.0,
    can_be: |_, _| true,
    places: |joint| {
        let speed = Member::free(joint.data.speed.clone()).positive();
        match joint.data.top_speed() > 0.0 {
            true => vec![Place::new(&joint.site, vec![speed])],
            false => Vec::new(),
        }
    },
    parameters: |_, blamed| vec![("twist_per_speed", blamed.amounts[0], "s")],
    would_tell: "hold the joint with the brakes on and load it at two rates: friction of the drive does not show then, a delay does",
};
