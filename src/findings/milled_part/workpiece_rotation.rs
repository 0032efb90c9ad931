//! The workpiece is turned against the frame of the job.

use super::Case;
use crate::findings::engine::Member;
use crate::findings::table::{Effect, Place};
use crate::ground::spatial::{V3, add, cross, dot, scale, sub};
use crate::inference::gaussian::Size;

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "workpiece_rotation",
    summary: "The workpiece is turned against the frame of the job.",
    mechanism: "datum",
    law_error: 0.0,
    can_be: |_, _| true,
    places: |case| vec![Place::new("workpiece", members(case))],
    parameters: |_, blamed| {
        let axes: &[&str] = match blamed.amounts.len() {
            1 => &["about_z"],
            _ => &["about_x", "about_y", "about_z"],
        };
        axes.iter()
            .zip(&blamed.amounts)
            .map(|(name, amount)| (*name, *amount, "rad"))
            .collect()
    },
    would_tell: "probe the datum faces of the workpiece at both ends",
};

/// About z alone, and about all axes, through the middle of what was probed.
fn members(case: &Case) -> Vec<Member> {
    let count = case.stations.len() as f64;
    let middle = case
        .stations
        .iter()
        .fold([0.0; 3], |sum, s| add(sum, scale(1.0 / count, s.tip)));
    let about = |k: usize| {
        let axis: V3 = std::array::from_fn(|i| f64::from(u8::from(i == k)));
        case.column(|s, row| dot(row.across, cross(axis, sub(s.tip, middle))))
    };
    let member = |axes: &[usize]| Member {
        columns: axes.iter().map(|k| about(*k)).collect(),
        size: Size::Free,
        positive: None,
        shape: vec![-1.0],
    };
    vec![member(&[2]), member(&[0, 1, 2])]
}
