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
        let square = |own: &[f64]| own.iter().map(|x| x * x).sum::<f64>();
        match blamed.shape[..] {
            [_, tests] => vec![("shift_rms", (square(&blamed.amounts) / tests).sqrt(), "m")],
            _ => vec![
                ("shift", square(&blamed.amounts[..3]).sqrt(), "m"),
                ("test", blamed.shape[0], "1"),
            ],
        }
    },
    would_tell: "measure a cube on the foundation too",
};

fn members(case: &Case) -> Vec<Member> {
    let mut members = Vec::new();
    let tests = case.tests();
    if tests.len() > 2 {
        members.push(restless(case, &tests));
    }
    for test in tests {
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

/// Another shift in every test.
fn restless(case: &Case, tests: &[i64]) -> Member {
    let one = |test: &i64, k: usize| column(case, *test, |c, _| f64::from(u8::from(c == k)));
    let columns = tests.iter().flat_map(|t| (0..3).map(move |k| one(t, k)));
    let columns: Vec<Vec<f64>> = columns.collect();
    Member {
        columns: columns.into_iter().filter(|c| c.contains(&1.0)).collect(),
        size: Size::Free,
        positive: None,
        shape: vec![0.0, tests.len() as f64],
    }
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
