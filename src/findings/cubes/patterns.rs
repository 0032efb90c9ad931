//! Movements of cubes that no cause of the library makes. They compete with the causes and are never named.

use super::Case;
use crate::findings::engine::Member;
use crate::findings::physics::OnRobot;
use crate::findings::table::{self, Pattern};
use crate::inference::gaussian::Size;

/// All of them.
pub(super) const PATTERNS: &[Pattern<Case>] = &[
    Pattern {
        name: "gain",
        summary: "one component of one cube reads too much or too little",
        members: gains,
    },
    Pattern {
        name: "uneven",
        summary: "an axis does not turn in proportion to its moment",
        members: uneven,
    },
    Pattern {
        name: "shift",
        summary: "what lies behind a link moves in proportion to the force, and not by turning",
        members: shifts,
    },
];

fn gains(case: &Case) -> Vec<Member> {
    let cubes = 0..case.test.facts.cubes.len();
    let one = |(cube, component): (usize, usize)| {
        let own = |i: usize| case.rows[i].cube == cube && case.rows[i].component == component;
        let column = (0..case.rows.len()).map(|i| if own(i) { case.simulated[i] } else { 0.0 });
        Member::free(column.collect()).shaped(&[cube as f64, component as f64])
    };
    let all = cubes
        .flat_map(|cube| (0..6).map(move |component| (cube, component)))
        .map(one);
    all.filter(|m| m.columns[0].iter().any(|x| *x != 0.0))
        .collect()
}

/// Share of its largest turn in all tests by which a turn is told from none.
const LEAST: f64 = 0.02;

/// A spring whose turn follows the sign of its moment (a gap), its size whichever sign it has, or its size more
/// than in proportion: the part of the spring in every test, divided or multiplied by its share of the largest.
fn uneven(case: &Case) -> Vec<Member> {
    let sites = case.robot.springs().map(|(site, _)| site);
    sites.filter_map(|site| of_spring(case, &site)).collect()
}

fn of_spring(case: &Case, site: &str) -> Option<Member> {
    const TRIED: f64 = 0.01;
    let part: Vec<f64> = case
        .change(&case.with_softer(site, TRIED))
        .iter()
        .map(|x| x / TRIED)
        .collect();
    let tests = case.tests();
    let at = |row: &super::Row| tests.iter().position(|t| *t == row.test).unwrap_or(0);
    // the turn in a test along that of the largest: cubes move alike, by more or less
    let places = 6 * case.test.facts.cubes.len();
    let mut parts = vec![vec![0.0; places]; tests.len()];
    for (row, p) in case.rows.iter().zip(&part) {
        parts[at(row)][6 * row.cube + row.component] += p;
    }
    let along = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let largest = parts
        .iter()
        .max_by(|a, b| along(a, a).total_cmp(&along(b, b)))?;
    let whole = along(largest, largest);
    if whole.sqrt() < case.noise {
        return None;
    }
    let turns: Vec<f64> = parts.iter().map(|p| along(p, largest) / whole).collect();
    let column = |of: &dyn Fn(f64) -> f64| {
        let row = |(row, p): (&super::Row, &f64)| {
            let turn = tests
                .iter()
                .position(|t| *t == row.test)
                .map_or(0.0, |at| turns[at]);
            if turn.abs() < LEAST {
                0.0
            } else {
                p * of(turn)
            }
        };
        case.rows.iter().zip(&part).map(row).collect::<Vec<f64>>()
    };
    Some(Member {
        columns: vec![
            column(&|t| t.abs().recip()),
            column(&|t| t.signum()),
            column(&|t| t.abs()),
        ],
        size: Size::Free,
        shape: vec![0.0],
        ..Member::free(Vec::new())
    })
}

/// All cubes behind an axis along each direction, in proportion to the force along it.
fn shifts(case: &Case) -> Vec<Member> {
    let behind = |joint: usize| {
        let column = |(to, from): (usize, usize)| -> Vec<f64> {
            let own = |row: &super::Row| {
                let moves = row.component == to && case.test.facts.cubes[row.cube].after >= joint;
                if moves {
                    case.test.readings[row.reading].force[from]
                } else {
                    0.0
                }
            };
            case.rows.iter().map(own).collect()
        };
        let pairs = (0..3).flat_map(|to| (0..3).map(move |from| (to, from)));
        pairs
            .map(column)
            .filter(|c| c.iter().any(|x| *x != 0.0))
            .collect::<Vec<_>>()
    };
    (0..=case.robot.dof())
        .flat_map(|joint| table::flexible(behind(joint)))
        .collect()
}
