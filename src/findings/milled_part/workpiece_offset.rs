//! The workpiece stands elsewhere than the job says.

use super::Case;
use super::stations::HARDLY;
use crate::findings::engine::{Blamed, Member};
use crate::findings::table::{Effect, Place, together};
use crate::ground::spatial::{IDENTITY, V3};

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "workpiece_offset",
    summary: "The workpiece stands elsewhere than the job says.",
    mechanism: "datum",
    law_error: 0.0,
    can_be: |_, _| true,
    places: |case| vec![Place::new("workpiece", members(case))],
    parameters: |case, blamed| {
        let shows = |k: &usize| case.rows.iter().any(|row| row.across[*k].abs() > HARDLY);
        let own = (0..3).filter(shows);
        own.map(|k| (["x", "y", "z"][k], blamed.amounts[k], "m"))
            .collect()
    },
    would_tell: "probe the datum faces of the workpiece before the cut",
};

/// Where the datum alone was probed elsewhere, and where the block stands elsewhere, too: the cut is deeper there.
fn members(case: &Case) -> Vec<Member> {
    let found = (0..3).map(|k| case.column(|_, row| row.across[k]));
    let stands = (0..3).map(|k| case.answered(&vec![IDENTITY[k]; case.stations.len()]));
    vec![
        together(found.collect(), &[-1.0, 0.0]),
        together(stands.collect(), &[-1.0, CUT]),
    ]
}

/// Marks the form in which the cut answers.
pub(super) const CUT: f64 = 1.0;

/// Where the tool goes at every station, m, if this is to blame and moves it before the cut answers.
pub(super) fn moves(case: &Case, blamed: &Blamed) -> Option<Vec<V3>> {
    let own = blamed.effect == EFFECT.name && blamed.shape.last() == Some(&CUT);
    let whole: V3 = blamed.amounts[..].try_into().ok().filter(|_| own)?;
    Some(vec![whole; case.stations.len()])
}
