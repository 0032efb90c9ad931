//! The screw's pitch, or the scale, is longer or shorter than stated: error = s x.

use super::Case;
use crate::findings::engine::Member;
use crate::findings::table::{Effect, Place};

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "pitch_scale",
    summary: "The error grows in proportion to the travel: the pitch is not the one that is stated.",
    mechanism: "pitch",
    law_error: 0.0,
    can_be: |_, _| true,
    places: |case| {
        let column = case.column(|i| case.at[i]);
        vec![Place::new("screw", vec![Member::free(column)])]
    },
    parameters: |_, blamed| vec![("scale", blamed.amounts[0], "m/m")],
    would_tell: "measure at targets that are not whole turns of the screw apart",
};
