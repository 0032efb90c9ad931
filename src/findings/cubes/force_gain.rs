//! The load reads wrong by a factor, force and moment alike.

use super::Case;
use crate::findings::engine::Member;
use crate::findings::table::{Effect, Place};

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "force_gain",
    summary: "The load reads too much or too little: every cube moves by one factor more or less.",
    mechanism: "load",
    places: |case| {
        vec![Place::new(
            "sensor",
            vec![Member::given(case.simulated.clone(), 0.15)],
        )]
    },
    parameters: |_, blamed| vec![("gain_error", blamed.amounts[0], "1")],
    would_tell: "calibrate the load with a dead weight",
};
