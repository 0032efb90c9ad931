//! The workpiece is turned against the frame of the job.

use super::Case;
use super::workpiece_offset::CUT;
use crate::findings::engine::{Blamed, Member};
use crate::findings::table::{Effect, Place, together};
use crate::ground::spatial::{IDENTITY, V3, add, cross, scale, sub};
use crate::inference::gaussian::Size;
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

/// How far a clamped workpiece may be turned, rad: a face of 100 mm is off by half a millimetre at its end. A turn of a part that is nearly
/// round is a shift of its middle, and nothing else would keep it small. A choice, no measurement.
const USUAL: f64 = 5e-3;

/// About z alone, and about all axes. Nobody states what stayed where it was: what was probed (its middle: an alignment to
/// it), the block (clamped by its middle), or the frame of the job (its orientation is wrong); nor whether the block is
/// turned, too, and cut elsewhere.
fn members(case: &Case) -> Vec<Member> {
    let member = |pivot: usize, still: V3, axes: &[usize], cut: f64| {
        let about = |k: &usize| {
            let turned = turned(case, still, IDENTITY[*k]);
            match cut == CUT {
                true => case.answered(&turned),
                false => case.seen(&turned),
            }
        };
        Member {
            size: Size::Given(USUAL),
            ..together(axes.iter().map(about).collect(), &[-1.0, pivot as f64, cut])
        }
    };
    let member = &member;
    let forms: [&[usize]; 2] = [&[2], &[0, 1, 2]];
    let places = pivots(case).into_iter().enumerate();
    places
        .flat_map(|(pivot, still)| {
            let forms = forms.into_iter();
            forms.flat_map(move |axes| [0.0, CUT].map(|cut| member(pivot, still, axes, cut)))
        })
        .collect()
}

/// Where every station goes by a turn about a pivot that stands still, m.
fn turned(case: &Case, still: V3, turn: V3) -> Vec<V3> {
    let each = case.stations.iter();
    each.map(|s| cross(turn, sub(s.tip, still))).collect()
}

/// Where the tool goes at every station, m, if this is to blame and moves it before the cut answers.
pub(super) fn moves(case: &Case, blamed: &Blamed) -> Option<Vec<V3>> {
    if blamed.effect != EFFECT.name || blamed.shape.last() != Some(&CUT) {
        return None;
    }
    let still = *pivots(case).get(blamed.shape[1] as usize)?;
    let turn = match blamed.amounts[..] {
        [z] => [0.0, 0.0, z],
        [x, y, z] => [x, y, z],
        _ => return None,
    };
    Some(turned(case, still, turn))
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
