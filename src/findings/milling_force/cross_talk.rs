//! A force along one axis shows on another, or the dynamometer is turned about the spindle axis.

use super::Case;
use super::setting::SENSOR;
use crate::findings::engine::Member;
use crate::findings::table::{Effect, Place};

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "cross_talk",
    summary: "A force along one axis of the sensor shows on another.",
    mechanism: "calibration",
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

/// Every pair, and x on y with y on x reversed: a turn about z.
fn members(case: &Case) -> Vec<Member> {
    let pairs = (0..3).flat_map(|from| {
        (0..3)
            .filter(move |to| *to != from)
            .map(move |to| (from, to))
    });
    let member = |(from, to): (usize, usize)| {
        let column = case.column(|c, i, k| match k == to {
            true => case.simulated(c, i)[from],
            false => 0.0,
        });
        Member::free(column).shaped(&[SENSOR, from as f64, to as f64])
    };
    let turned = case.column(|c, i, k| {
        let f = case.simulated(c, i);
        [-f[1], f[0], 0.0][k]
    });
    let turn = Member::free(turned).shaped(&[SENSOR, 0.0, 1.0, -1.0]);
    let mut all: Vec<Member> = pairs.map(member).chain([turn]).collect();
    all.retain(|m| m.columns[0].iter().any(|x| *x != 0.0));
    all
}
