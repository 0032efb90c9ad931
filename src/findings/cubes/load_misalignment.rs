//! The load points elsewhere than it is said to: force and moment turned about an axis of the base frame.

use super::Case;
use crate::findings::engine::Member;
use crate::findings::table::{Effect, Place};
use crate::ground::stats::length;
use crate::inference::gaussian::Size;

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "load_misalignment",
    summary: "The load points elsewhere than it is said to, in the base frame.",
    // beside a gain it turns what that multiplies: exact both, neither mends the other's law
    mechanism: "direction",
    law_error: 0.0,
    can_be: |_, _| true,
    places: |case| vec![Place::new("sensor", members(case))],
    parameters: |_, blamed| {
        let size = length(&blamed.amounts);
        vec![("angle", size, "rad")]
    },
    would_tell: "measure the direction of the cables",
};

/// Ordinary angle, and the one it is tried at, rad.
const ORDINARY: f64 = 0.05;
const TRIED: f64 = 1e-3;

fn members(case: &Case) -> Vec<Member> {
    let column = |k: usize| {
        let mut turn = case.about.turn();
        turn[k] += TRIED;
        let more = case.under(case.about.gain(), turn);
        more.iter().map(|x| x / TRIED).collect::<Vec<f64>>()
    };
    let columns: Vec<Vec<f64>> = (0..3).map(column).collect();
    let single = columns
        .iter()
        .enumerate()
        .map(|(k, c)| Member::given(c.clone(), ORDINARY).shaped(&[k as f64]));
    let all = Member {
        columns: columns.clone(),
        size: Size::Given(ORDINARY),
        shape: vec![3.0],
        ..Member::free(Vec::new())
    };
    single.chain([all]).collect()
}
