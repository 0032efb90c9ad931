//! The tool is larger or smaller than stated: its edge stands nearer to the wall, and it meets more material, which
//! bends it away.

use super::Case;
use crate::findings::engine::Member;
use crate::findings::table::{Effect, Place};

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "tool_radius",
    summary: "The tool is larger or smaller than stated.",
    mechanism: "tool",
    law_error: 0.0,
    can_be: |_, _| true,
    places: |case| vec![Place::new("tool", members(case))],
    parameters: |_, blamed| vec![("radius_error", blamed.amounts[0], "m")],
    would_tell: "measure the tool, or probe walls on both sides of the feed",
};

/// Only a wall tells it: `side` of the file.
fn members(case: &Case) -> Vec<Member> {
    let Some(side) = case.test.facts.side else {
        return Vec::new();
    };
    let edge = |left: bool| if left { side } else { 0.0 };
    let rows = case.rows.iter().zip(&case.larger);
    let column = rows.map(|(row, gives)| edge(row.left) + gives).collect();
    vec![Member::free(column).shaped(&[-1.0])]
}
