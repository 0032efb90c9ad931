//! The tool is larger or smaller than stated: the wall moves away from it, or towards it.

use super::Case;
use crate::findings::engine::Member;
use crate::findings::table::{Effect, Place};

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "tool_radius",
    summary: "The tool is larger or smaller than stated.",
    mechanism: "tool",
    places: |case| vec![Place::new("tool", members(case))],
    parameters: |_, blamed| vec![("radius_error", blamed.amounts[0], "m")],
    would_tell: "measure the tool, or probe walls on both sides of the feed",
};

/// Only a wall tells it: `side` of the file.
fn members(case: &Case) -> Vec<Member> {
    let Some(side) = case.test.facts.side else {
        return Vec::new();
    };
    let column = case.column(|_, row| if row.left { side } else { 0.0 });
    vec![Member::free(column).shaped(&[-1.0])]
}
