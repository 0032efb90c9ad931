//! The sensor is mounted turned about its own axes.

use super::Case;
use crate::findings::engine::Member;
use crate::findings::table::{Effect, Place, each_and_all};

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "sensor_rotation",
    summary: "The sensor is mounted turned about its own axes.",
    mechanism: "turn",
    law_error: 0.0,
    can_be: |_, _| true,
    places: |case| vec![Place::new("sensor", members(case))],
    parameters: |_, blamed| {
        const NAMES: [&str; 3] = ["rotation_x", "rotation_y", "rotation_z"];
        let own = blamed.shape.iter().zip(&blamed.amounts);
        own.map(|(k, amount)| (NAMES[*k as usize], *amount, "rad"))
            .collect()
    },
    would_tell: "turn the tool on the sensor and repeat",
};

fn members(case: &Case) -> Vec<Member> {
    each_and_all(3, |k| case.parameter(10 + k))
}
