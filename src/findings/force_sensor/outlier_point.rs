//! One orientation does not fit the others: it was written down wrong (a turn of the whole load), or the tool
//! touched something there.

use super::Case;
use crate::findings::engine::Member;
use crate::findings::table::{Effect, Place, together};
use crate::ground::spatial::{V3, cross};
use crate::ground::stats::length;

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "outlier_point",
    summary: "One orientation does not fit the others.",
    mechanism: "outlier",
    law_error: 0.0,
    can_be: |_, _| true,
    places: |case| {
        let place =
            |(at, name): (usize, &i64)| Place::new(format!("point{name}"), members(case, at));
        match case.points.1.len() {
            0..5 => Vec::new(),
            _ => case.points.1.iter().enumerate().map(place).collect(),
        }
    },
    parameters: |_, blamed| match blamed.shape[0] {
        0.0 => vec![("turn", length(&blamed.amounts), "rad")],
        _ => vec![("force", length(&blamed.amounts[..3]), "N")],
    },
    would_tell: "repeat that orientation",
};

fn members(case: &Case, at: usize) -> Vec<Member> {
    let here = |i: usize| case.points.0[i] == at;
    let turned = |k: usize| {
        let axis: V3 = std::array::from_fn(|j| f64::from(u8::from(j == k)));
        case.column(|i, c| {
            let first = 3 * (c / 3);
            let load: V3 = std::array::from_fn(|j| case.load(i, j));
            match (here(i), first) {
                (false, _) => 0.0,
                // the weight turns against the sensor, its moment follows about the centre of mass
                (true, 0) => cross(load, axis)[c],
                (true, _) => cross(
                    [case.nominal[1], case.nominal[2], case.nominal[3]],
                    cross(load, axis),
                )[c - 3],
            }
        })
    };
    let free = |own: usize| case.column(|i, c| if here(i) && c == own { 1.0 } else { 0.0 });
    let member = |columns: Vec<Vec<f64>>, shape: f64| together(columns, &[shape]);
    vec![
        member((0..3).map(turned).collect(), 0.0),
        member((0..6).map(free).collect(), 1.0),
    ]
}
