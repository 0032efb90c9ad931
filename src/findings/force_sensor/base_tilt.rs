//! The base of the robot is not level.

use super::Case;
use crate::findings::engine::Member;
use crate::findings::table::{Effect, Place};
use crate::inference::gaussian::Size;

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "base_tilt",
    summary: "The base of the robot is not level.",
    mechanism: "tilt",
    law_error: 0.0,
    can_be: |_, _| true,
    places: |case| {
        let column = |k: usize| case.parameter(13 + k);
        let single = (0..2).map(|k| Member::free(column(k)).shaped(&[k as f64]));
        let both = Member {
            columns: (0..2).map(column).collect(),
            size: Size::Free,
            positive: None,
            shape: vec![0.0, 1.0],
        };
        vec![Place::new("base", single.chain([both]).collect())]
    },
    parameters: |_, blamed| {
        const NAMES: [&str; 2] = ["base_tilt_x", "base_tilt_y"];
        let own = blamed.shape.iter().zip(&blamed.amounts);
        own.map(|(k, amount)| (NAMES[*k as usize], *amount, "rad"))
            .collect()
    },
    would_tell: "put a level on the base",
};
