//! The frame of the sensors moved against the foundation in one test: all cubes of the test shift alike.

use super::Case;
use crate::findings::engine::Member;
use crate::findings::table::{Effect, Place};
use crate::ground::spatial::{V3, cross, sub};
use crate::inference::gaussian::Size;

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "frame_motion",
    summary: "The measuring frame moved: all cubes of a test shift alike.",
    mechanism: "frame",
    places: |case| vec![Place::new("frame", members(case))],
    parameters: |_, blamed| {
        let size = blamed.amounts[..3]
            .iter()
            .map(|x| x * x)
            .sum::<f64>()
            .sqrt();
        vec![("shift", size, "m"), ("test", blamed.shape[0], "1")]
    },
    would_tell: "measure a cube on the foundation too",
};

fn members(case: &Case) -> Vec<Member> {
    let mut members = Vec::new();
    for test in case.tests() {
        let shift = |k: usize| column(case, test, |c, _| f64::from(u8::from(c == k)));
        let turn = |k: usize| {
            let axis: V3 = std::array::from_fn(|j| f64::from(u8::from(j == k)));
            column(case, test, |c, at| {
                if c < 3 {
                    cross(axis, at)[c]
                } else {
                    axis[c - 3] * case.arm
                }
            })
        };
        let shifts: Vec<Vec<f64>> = (0..3).map(shift).collect();
        let both = shifts.iter().cloned().chain((0..3).map(turn)).collect();
        for columns in [shifts, both] {
            members.push(Member {
                columns,
                size: Size::Free,
                positive: None,
                shape: vec![test as f64],
            });
        }
    }
    members
}

/// Rows of one test from component and place of the cube (less that of the first).
fn column(case: &Case, test: i64, of: impl Fn(usize, V3) -> f64) -> Vec<f64> {
    let cubes = &case.test.facts.cubes;
    let row = |row: &super::Row| match row.test == test {
        true => of(row.component, sub(cubes[row.cube].centre, cubes[0].centre)),
        false => 0.0,
    };
    case.rows.iter().map(row).collect()
}
