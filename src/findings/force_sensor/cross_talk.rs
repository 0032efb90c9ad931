//! A force along one axis shows on another channel: six pairs of forces, nine of a force and a moment. All of
//! a force's moments together are a shift of the centre, a single one is not.

use super::Case;
use crate::findings::engine::Member;
use crate::findings::table::{Effect, Place};

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "cross_talk",
    summary: "A force along one axis of the sensor shows on another.",
    mechanism: "cross-talk",
    law_error: 0.0,
    can_be: |_, _| true,
    places: |case| vec![Place::new("sensor", members(case))],
    parameters: |_, blamed| {
        vec![
            (
                "share",
                blamed.amounts[0],
                if blamed.shape[1] < 3.0 { "1" } else { "m" },
            ),
            ("from_axis", blamed.shape[0], "1"),
            ("to_axis", blamed.shape[1], "1"),
        ]
    },
    would_tell: "hang a known weight on the sensor in all directions",
};

fn members(case: &Case) -> Vec<Member> {
    let pairs = (0..3).flat_map(|from| {
        (0..6)
            .filter(move |to| *to != from)
            .map(move |to| (from, to))
    });
    let member = |(from, to): (usize, usize)| {
        let column = case.column(|i, c| if c == to { case.load(i, from) } else { 0.0 });
        Member::free(column).shaped(&[from as f64, to as f64])
    };
    pairs.map(member).collect()
}
