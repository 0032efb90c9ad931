//! Forces that no cause of the library makes. They compete with the causes and are never named.

use super::Case;
use crate::findings::engine::Member;
use crate::findings::table::{self, Pattern};
use crate::inference::gaussian::Size;

/// All of them.
pub(super) const PATTERNS: &[Pattern<Case>] = &[
    Pattern {
        name: "uneven",
        summary: "the whole force waxes and wanes during the cuts",
        members: uneven,
    },
    Pattern {
        name: "bend",
        summary: "a channel is not in proportion to its force",
        members: bends,
    },
];

/// Pieces of the record whose force may be more or less than simulated.
const PIECES: usize = 24;

fn uneven(case: &Case) -> Vec<Member> {
    let hat = |piece: usize| {
        let near = |c: usize, i: usize| {
            let apart = case.progress(c, i) * (PIECES - 1) as f64 - piece as f64;
            (1.0 - apart.abs()).max(0.0)
        };
        case.column(|c, i, k| near(c, i) * case.simulated(c, i)[k])
    };
    table::flexible((0..PIECES).map(hat).collect())
}

/// Shares of its largest force from which a channel may show less.
const LIMITS: [f64; 3] = [0.5, 0.7, 0.85];

/// One channel, or all, over the square of the force, its square with sign, and what lies beyond a limit.
fn bends(case: &Case) -> Vec<Member> {
    let axes: [&[usize]; 4] = [&[0], &[1], &[2], &[0, 1, 2]];
    axes.iter().map(|own| bend(case, own)).collect()
}

fn bend(case: &Case, axes: &[usize]) -> Member {
    let all = case.forces();
    let own = all
        .iter()
        .enumerate()
        .filter(|(row, _)| axes.contains(&(row % 3)));
    let most = own.fold(f64::MIN_POSITIVE, |m, (_, f)| m.max(f.abs()));
    let column = |of: &dyn Fn(f64) -> f64| {
        case.column(|c, i, k| match axes.contains(&k) {
            true => most * of(case.simulated(c, i)[k] / most),
            false => 0.0,
        })
    };
    let beyond = |limit: f64| move |x: f64| (x.abs() - limit).max(0.0) * x.signum();
    let mut columns = vec![column(&|x| x * x), column(&|x| x * x.abs())];
    columns.extend(LIMITS.map(|limit| column(&beyond(limit))));
    Member {
        columns,
        size: Size::Free,
        positive: None,
        shape: vec![axes.len() as f64],
    }
}
