//! The tool weighs more or less than it is said to.

use super::Case;
use crate::findings::engine::Member;
use crate::findings::table::{Effect, Place};

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "tool_weight",
    summary: "The tool weighs more or less than it is said to.",
    mechanism: "weight",
    law_error: 0.0,
    can_be: |_, _| true,
    places: |case| match case.stated[0] {
        true => vec![Place::new("tool", vec![Member::free(case.parameter(0))])],
        false => Vec::new(),
    },
    parameters: |case, blamed| vec![("weight", case.nominal[0] + blamed.amounts[0], "N")],
    would_tell: "weigh the tool, or hang a known weight on the sensor",
};
