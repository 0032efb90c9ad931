//! The load reads wrong by a factor, force and moment alike.

use super::Case;
use crate::findings::engine::Member;
use crate::findings::table::{Effect, Place};

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "force_gain",
    summary: "The load reads too much or too little: every cube moves by one factor more or less.",
    mechanism: "load",
    law_error: 0.0,
    can_be: |_, _| true,
    places: |case| {
        let more = case.under(case.about.gain() + TRIED, case.about.turn());
        let column = more.iter().map(|x| x / TRIED).collect();
        vec![Place::new("sensor", vec![Member::given(column, 0.15)])]
    },
    parameters: |_, blamed| vec![("gain_error", blamed.amounts[0], "1")],
    would_tell: "calibrate the load with a dead weight",
};

/// Gain that it is tried at: what it does is all but linear.
const TRIED: f64 = 1e-3;
