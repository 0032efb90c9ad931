//! Lost motion: the ways forth and back differ by a constant.

use super::Case;
use crate::findings::engine::Member;
use crate::findings::table::{Effect, Place};

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "backlash",
    summary: "The ways forth and back differ by a constant: lost motion between screw and nut.",
    mechanism: "lost motion",
    law_error: 0.0,
    can_be: |_, _| true,
    places: |case| {
        let members = match case.both_ways() {
            true => vec![Member::free(case.side.clone())],
            false => Vec::new(),
        };
        vec![Place::new("screw", members)]
    },
    parameters: |_, blamed| vec![("gap", blamed.amounts[0], "m")],
    would_tell: "measure both directions along the whole travel",
};
