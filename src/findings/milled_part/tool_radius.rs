//! The tool is larger or smaller than stated: its edge stands nearer to the wall, and it meets more material, which
//! bends it away.

use super::Case;
use crate::findings::engine::{Blamed, Member};
use crate::findings::table::{Effect, Place};
use crate::process::setup::Setup;

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
    let on_wall = |left: bool| if left { side } else { 0.0 };
    let rows = case.rows.iter().zip(&case.larger);
    let column = rows.map(|(row, gives)| on_wall(row.left) + gives).collect();
    vec![Member::free(column).shaped(&[-1.0])]
}

/// Puts the cause into the tool; false for others. Its edge on the wall is straight anyway.
pub(super) fn alter(blamed: &Blamed, setup: &mut Setup) -> bool {
    let own = blamed.effect == EFFECT.name;
    if own {
        setup.tool.radius_m += blamed.amounts[0];
    }
    own
}

/// What its edge adds to a row by standing nearer to the wall, m; none for others.
pub(super) fn edge(case: &Case, blamed: &Blamed, row: usize) -> f64 {
    match (blamed.effect == EFFECT.name, case.rows[row].left) {
        (true, true) => case.test.facts.side.unwrap_or(0.0) * blamed.amounts[0],
        _ => 0.0,
    }
}
