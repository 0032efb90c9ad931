//! The workpiece is turned against the frame of the job.

use super::Case;
use crate::findings::engine::Member;
use crate::findings::table::{Effect, Place, together};
use crate::ground::spatial::{V3, add, cross, dot, scale, sub};
use crate::measurement::job::Stock;

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

/// About z alone, and about all axes. Nobody states what stayed where it was: what was probed (its middle: an alignment to
/// it), the block (clamped by its middle), or the frame of the job (its orientation is wrong).
fn members(case: &Case) -> Vec<Member> {
    let about = |k: usize, still: V3| {
        let axis: V3 = std::array::from_fn(|i| f64::from(u8::from(i == k)));
        case.column(|s, row| dot(row.across, cross(axis, sub(s.tip, still))))
    };
    let member = |(axes, still): (&[usize], V3)| {
        together(axes.iter().map(|k| about(*k, still)).collect(), &[-1.0])
    };
    let forms: [&[usize]; 2] = [&[2], &[0, 1, 2]];
    let places = pivots(case).into_iter();
    places
        .flat_map(|still| forms.map(|axes| member((axes, still))))
        .collect()
}

/// Where a workpiece may be held while it is turned, m.
fn pivots(case: &Case) -> Vec<V3> {
    let count = case.stations.len() as f64;
    let each = case.stations.iter();
    let probed = each.fold([0.0; 3], |sum, s| add(sum, scale(1.0 / count, s.tip)));
    let mut all = vec![probed, [0.0; 3]];
    if let Some(Stock::Box { min, max }) = &case.planned.job.workpiece.stock {
        all.push(scale(0.5, add(*min, *max)));
    }
    all
}
