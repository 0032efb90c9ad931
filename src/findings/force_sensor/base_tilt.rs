//! The base of the robot is not level.

use super::Case;
use crate::findings::table::{Effect, Place, each_and_all};

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "base_tilt",
    summary: "The base of the robot is not level.",
    mechanism: "tilt",
    law_error: 0.0,
    can_be: |_, _| true,
    places: |case| {
        let members = each_and_all(2, |k| case.parameter(13 + k));
        vec![Place::new("base", members)]
    },
    parameters: |_, blamed| {
        const NAMES: [&str; 2] = ["base_tilt_x", "base_tilt_y"];
        let own = blamed.shape.iter().zip(&blamed.amounts);
        own.map(|(k, amount)| (NAMES[*k as usize], *amount, "rad"))
            .collect()
    },
    would_tell: "put a level on the base",
};
