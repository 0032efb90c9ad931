//! The spindle turns faster or slower than stated: in all cuts, or in one.

use super::Case;
use super::coefficients::member;
use super::engagement::errors;
use super::setting::Places;
use crate::findings::table::{Effect, Place};

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "spindle_speed",
    summary: "The spindle turns at another speed than stated.",
    mechanism: "speed",
    // it shifts waves and does not change them
    law_error: 0.002,
    can_be: |_, _| true,
    places: |case| {
        let places = case.places();
        let of = |cuts: std::ops::Range<usize>| {
            let mut direction = vec![0.0; places.len()];
            cuts.for_each(|c| direction[places.speed(c)] = 1e-3);
            member(case, &[direction])
        };
        let single = (0..places.cuts)
            .filter(|_| places.cuts > 1)
            .map(|c| of(c..c + 1));
        let members = std::iter::once(of(0..places.cuts)).chain(single).collect();
        vec![Place::new("spindle", members)]
    },
    parameters: |case, blamed| {
        errors(case, blamed, Places::speed)
            .into_iter()
            .flat_map(|(cut, error)| {
                let number = cut.map(|c| ("cut", (c + 1) as f64, "1"));
                std::iter::once(("speed_error", error, "1")).chain(number)
            })
            .collect()
    },
    would_tell: "measure the speed with a tachometer under load",
};
