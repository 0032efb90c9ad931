//! A cube that does not move with its link: it follows its neighbour by a share, or slips in one test.

use super::Case;
use crate::findings::engine::{Blamed, Member};
use crate::findings::table::{Effect, Place, together};
use crate::ground::spatial::{cross, sub};
use crate::ground::stats::length;

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "loose_cube",
    summary: "A cube does not move with its link: it follows its neighbour by a share, or slips.",
    mechanism: "loose_cube",
    // what a loose cube follows is no neighbour alone
    law_error: 0.05,
    can_be: |_, _| true,
    places: |case| {
        (0..case.test.facts.cubes.len())
            .map(|cube| {
                Place::new(
                    case.test.facts.cubes[cube].name.clone(),
                    members(case, cube),
                )
            })
            .collect()
    },
    parameters: |_, blamed| match blamed.shape.get(1) {
        Some(test) if blamed.amounts.len() > 1 => {
            let size = length(&blamed.amounts[..3]);
            vec![("slip", size, "m"), ("test", *test, "1")]
        }
        Some(test) => vec![("share", blamed.amounts[0], "1"), ("test", *test, "1")],
        None => vec![("share", blamed.amounts[0], "1")],
    },
    would_tell: "fasten the cube and repeat",
};

fn members(case: &Case, cube: usize) -> Vec<Member> {
    let own = |i: usize| case.rows[i].cube == cube;
    let with_own = |of: &dyn Fn(usize) -> f64| -> Vec<f64> {
        (0..case.rows.len())
            .map(|i| if own(i) { of(i) } else { 0.0 })
            .collect()
    };
    if !case.rows.iter().any(|row| row.cube == cube) {
        return Vec::new();
    }
    let ways = 1 + 2 * neighbours(case, cube).len();
    let targets: Vec<Vec<f64>> = (0..ways)
        .map(|way| target(case, cube, way, &case.fixed))
        .collect();
    let shaped = |(way, column): (usize, &Vec<f64>)| {
        Member::given(column.clone(), 0.3)
            .positive()
            .shaped(&[way as f64])
    };
    let mut members: Vec<Member> = targets.iter().enumerate().map(shaped).collect();
    for test in case.tests() {
        let here = |column: &[f64]| -> Vec<f64> {
            column
                .iter()
                .enumerate()
                .map(|(i, x)| if case.rows[i].test == test { *x } else { 0.0 })
                .collect()
        };
        members.push(Member::free(here(&targets[0])).shaped(&[0.0, test as f64]));
        let part = |k: usize| {
            here(&with_own(&|i| {
                if case.rows[i].component == k {
                    if k < 3 { 1.0 } else { case.arm }
                } else {
                    0.0
                }
            }))
        };
        let columns: Vec<Vec<f64>> = (0..6)
            .map(part)
            .filter(|c| c.iter().any(|x| *x != 0.0))
            .collect();
        members.push(together(columns, &[1.0, test as f64]));
    }
    members
}

/// Whether a cause is a cube that follows another by a share in all tests.
pub(super) fn follows(blamed: &Blamed) -> bool {
    blamed.effect == EFFECT.name && blamed.shape.len() == 1
}

/// What a cube shows more that follows standing still (way 0), or one of its neighbours altogether: moved alike, or swung
/// with it as if it stood on its link.
pub(super) fn target(case: &Case, cube: usize, way: usize, fixed: &[f64]) -> Vec<f64> {
    let neighbours = neighbours(case, cube);
    let Some(way) = way.checked_sub(1).filter(|_| !neighbours.is_empty()) else {
        let still = |i: usize| {
            if case.rows[i].cube == cube {
                -fixed[i]
            } else {
                0.0
            }
        };
        return (0..case.rows.len()).map(still).collect();
    };
    let neighbour = neighbours[way % neighbours.len()];
    let lever = match way < neighbours.len() {
        true => [0.0; 3],
        false => {
            let centre = |c: usize| case.test.facts.cubes[c].centre;
            sub(centre(cube), centre(neighbour))
        }
    };
    let shown = |test: i64, component: usize| {
        let mut own = case.rows.iter().zip(fixed);
        let found = own.find(|(row, _)| {
            row.cube == neighbour && row.test == test && row.component == component
        });
        found.map(|(_, moved)| *moved)
    };
    let moved = |i: usize| {
        let row = &case.rows[i];
        let turn = [3, 4, 5].map(|k| shown(row.test, k).unwrap_or(0.0) / case.arm);
        let swung = cross(turn, lever);
        let more = swung.get(row.component).copied().unwrap_or(0.0);
        shown(row.test, row.component).map_or(0.0, |moved| moved + more - fixed[i])
    };
    let own = |i: usize| {
        if case.rows[i].cube == cube {
            moved(i)
        } else {
            0.0
        }
    };
    (0..case.rows.len()).map(own).collect()
}

/// The cubes before and behind it.
fn neighbours(case: &Case, cube: usize) -> Vec<usize> {
    let mut order: Vec<usize> = (0..case.test.facts.cubes.len()).collect();
    order.sort_by_key(|c| case.setup.hinges_before(*c));
    let at = order.iter().position(|c| *c == cube).unwrap_or(0);
    [at.checked_sub(1), Some(at + 1)]
        .into_iter()
        .flatten()
        .filter_map(|i| order.get(i).copied())
        .collect()
}
