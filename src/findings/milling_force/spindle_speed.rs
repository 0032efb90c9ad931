//! The spindle turns faster or slower than stated: in all cuts, or in one.

use super::Case;
use super::engagement::{errors, members};
use super::setting::Places;
use crate::findings::table::{Effect, Place};

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "spindle_speed",
    summary: "The spindle turns at another speed than stated.",
    mechanism: "speed",
    places: |case| {
        let cuts: Vec<usize> = (0..case.cuts().len()).collect();
        // the same share in all cuts is the one law of a common cause
        vec![Place::new("spindle", members(case, &cuts, Places::speed, &|_| 1.0))]
    },
    parameters: |case, blamed| {
        errors(case, blamed, Places::speed)
            .into_iter()
            .flat_map(|(cut, error)| {
                let number = cut.map(|c| ("cut", (c + 1) as f64, "1"));
                number.into_iter().chain([("speed_error", error, "1")])
            })
            .collect()
    },
    would_tell: "measure the speed with a tachometer under load",
};
