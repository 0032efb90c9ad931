//! The frame of the sensors moved against the foundation in one test: all cubes of the test shift alike.

use super::Case;
use crate::findings::engine::Member;
use crate::findings::table::{Effect, Place, together};
use crate::ground::spatial::{V3, cross, sub};
use crate::ground::stats::length;

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "frame_motion",
    summary: "The measuring frame moved: all cubes of a test shift alike.",
    mechanism: "frame",
    // a frame that shifts in every test turns as well, by some tenths of it
    law_error: 0.3,
    can_be: |_, _| true,
    places: |case| vec![Place::new("frame", members(case))],
    parameters: |_, blamed| match blamed.shape[..] {
        [_, tests] => vec![("shift_rms", length(&blamed.amounts) / tests.sqrt(), "m")],
        _ => vec![
            ("shift", length(&blamed.amounts[..3]), "m"),
            ("test", blamed.shape[0], "1"),
        ],
    },
    would_tell: "measure a cube on the foundation too",
};

fn members(case: &Case) -> Vec<Member> {
    let tests = case.tests();
    let one = |test: &i64, turns: bool| together(moves(case, *test, turns), &[*test as f64]);
    let every = (tests.len() > 2)
        .then(|| restless(case, &tests))
        .into_iter();
    let each = tests
        .iter()
        .flat_map(|test| [one(test, false), one(test, true)]);
    every.chain(each).collect()
}

/// Shifts of the frame in a test along all axes, and turns about them.
fn moves(case: &Case, test: i64, turns: bool) -> Vec<Vec<f64>> {
    let shift = |k: usize| column(case, test, |c, _| f64::from(u8::from(c == k)));
    let turn = |k: usize| {
        let axis: V3 = std::array::from_fn(|j| f64::from(u8::from(j == k)));
        column(case, test, |c, at| match c {
            0..3 => cross(axis, at)[c],
            _ => axis[c - 3] * case.arm,
        })
    };
    let turns = (0..3).filter(|_| turns).map(turn);
    (0..3).map(shift).chain(turns).collect()
}

/// Another shift in every test.
fn restless(case: &Case, tests: &[i64]) -> Member {
    let columns = tests.iter().flat_map(|test| moves(case, *test, false));
    together(
        columns.filter(|c| c.contains(&1.0)).collect(),
        &[0.0, tests.len() as f64],
    )
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
