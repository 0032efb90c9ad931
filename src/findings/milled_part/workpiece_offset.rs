//! The workpiece stands elsewhere than the job says.

use super::Case;
use crate::findings::engine::Member;
use crate::findings::table::{Effect, Place, together};

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "workpiece_offset",
    summary: "The workpiece stands elsewhere than the job says.",
    mechanism: "datum",
    law_error: 0.0,
    can_be: |_, _| true,
    places: |case| vec![Place::new("workpiece", members(case))],
    parameters: |_, blamed| {
        let names = ["x", "y", "z"].iter();
        names
            .zip(&blamed.amounts)
            .map(|(name, amount)| (*name, *amount, "m"))
            .collect()
    },
    would_tell: "probe the datum faces of the workpiece before the cut",
};

fn members(case: &Case) -> Vec<Member> {
    vec![together(
        (0..3)
            .map(|k| case.column(|_, row| row.across[k]))
            .collect(),
        &[-1.0],
    )]
}
