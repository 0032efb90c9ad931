//! The sensor is mounted turned about its own axes.

use super::Case;
use crate::findings::engine::Member;
use crate::findings::table::{Effect, Place};
use crate::inference::gaussian::Size;

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
    let column = |k: usize| case.parameter(10 + k);
    let single = (0..3).map(|k| Member::free(column(k)).shaped(&[k as f64]));
    let all = Member {
        columns: (0..3).map(column).collect(),
        size: Size::Free,
        positive: None,
        shape: vec![0.0, 1.0, 2.0],
    };
    single.chain([all]).collect()
}
