//! An elastic axis that the robot has is softer or stiffer than it is stated: of the foundation, of a link,
//! or beyond the last joint.

use super::Case;
use crate::causes::places::{LEAST_EXCESS, softened};
use crate::findings::engine::{Blamed, Member};
use crate::findings::physics::OnRobot;
use crate::findings::table::{Effect, Place};
use crate::ground::stats::length;

pub(super) const BASE: Effect<Case> = effect(
    "base_compliance",
    "An elastic axis of the foundation is softer or stiffer than stated.",
    |case| places(case, |after, _| after == 0),
);
pub(super) const LINK: Effect<Case> = effect(
    "link_compliance",
    "An elastic axis of a link is softer or stiffer than stated.",
    |case| places(case, |after, last| after > 0 && after < last),
);
pub(super) const TOOL: Effect<Case> = effect(
    "tool_compliance",
    "An elastic axis beyond the last joint is softer or stiffer than stated.",
    |case| places(case, |after, last| after == last),
);

const fn effect(
    name: &'static str,
    summary: &'static str,
    places: fn(&Case) -> Vec<Place>,
) -> Effect<Case> {
    Effect {
        name,
        summary,
        mechanism: name,
        law_error: 0.0,
        can_be: |_, amounts| amounts[0] > LEAST_EXCESS,
        places,
        parameters,
        would_tell: "put a cube on either side of it",
    }
}

/// Shape that no cause of the robot has.
const OWN: f64 = -1.0;
/// Ordinary relative excess of a compliance, and the one it is tried at.
const ORDINARY: f64 = 0.4;
const TRIED: f64 = 0.01;

fn places(case: &Case, own: fn(usize, usize) -> bool) -> Vec<Place> {
    let last = case.robot.dof();
    let axes = case
        .robot
        .elastic
        .iter()
        .filter(|axis| own(axis.after, last));
    axes.map(|axis| Place::new(axis.name.clone(), members(case, &axis.name)))
        .collect()
}

fn members(case: &Case, site: &str) -> Vec<Member> {
    let robot = case.with_softer(site, TRIED);
    let column: Vec<f64> = case.change(&robot).iter().map(|x| x / TRIED).collect();
    let size = length(&column);
    match size > 1e-3 * case.noise {
        true => vec![Member::given(column, ORDINARY).shaped(&[OWN])],
        false => Vec::new(),
    }
}

/// Whether a cause is of this file.
pub(super) fn is_one(blamed: &Blamed) -> bool {
    blamed.shape == [OWN]
}

fn parameters(case: &Case, blamed: &Blamed) -> Vec<(&'static str, f64, &'static str)> {
    softened(&case.robot, &blamed.site, blamed.amounts[0])
}
