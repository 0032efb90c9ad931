//! Forces that no cause of the library makes. They compete with the causes and are never named.

use super::Case;
use crate::findings::engine::Member;
use crate::findings::table::{self, Pattern};
use crate::inference::gaussian::Size;
use crate::signal::mains::MAINS_HZ;
use std::f64::consts::TAU;

/// All of them.
pub(super) const PATTERNS: &[Pattern<Case>] = &[
    Pattern {
        name: "uneven",
        summary: "the whole force waxes and wanes within the cuts",
        members: uneven,
    },
    Pattern {
        name: "hum",
        summary: "a channel hums with the mains",
        members: hums,
    },
    Pattern {
        name: "bend",
        summary: "a channel is not in proportion to its force",
        members: bends,
    },
];

/// Pieces of the record whose force may be more or less than simulated.
const PIECES: usize = 24;
/// Harmonics of the mains that are tried: rectifiers make them.
const HARMONICS: [f64; 3] = [1.0, 2.0, 3.0];
/// Nats from which a hum is worth a comparison.
const HUM: f64 = 12.0;

/// Within the cuts: what differs from cut to cut is what causes do.
fn uneven(case: &Case) -> Vec<Member> {
    let hat = |piece: usize| {
        let near = |c: usize, i: usize| {
            let apart = case.progress(c, i) * (PIECES - 1) as f64 - piece as f64;
            (1.0 - apart.abs()).max(0.0)
        };
        let means = case.cuts().iter().enumerate().map(|(c, cut)| {
            let count = cut.time.len();
            (0..count).map(|i| near(c, i)).sum::<f64>() / count.max(1) as f64
        });
        let means: Vec<f64> = means.collect();
        case.column(|c, i, k| (near(c, i) - means[c]) * case.simulated(c, i)[k])
    };
    table::flexible((0..PIECES).map(hat).collect())
}

/// One channel at the frequency that suits it best, in every cut with a phase of its own.
fn hums(case: &Case) -> Vec<Member> {
    let wave = |axis: usize, hz: f64| -> Vec<Vec<f64>> {
        let phases = (0..case.cuts().len()).flat_map(|cut| [0.0, 0.25].map(|q| (cut, q)));
        let one = |(cut, quarter): (usize, f64)| {
            case.column(|c, i, k| match c == cut && k == axis {
                true => (TAU * (hz * case.cuts()[c].time[i] - quarter)).cos(),
                false => 0.0,
            })
        };
        phases.map(one).collect()
    };
    let best = |axis: usize| {
        let tried = HARMONICS.iter().flat_map(|n| MAINS_HZ.map(|hz| n * hz));
        let waves = tried.map(|hz| wave(axis, hz));
        let gains = waves.map(|w| (case.aim().gain_of(&w), w));
        gains.reduce(|a, b| if b.0 > a.0 { b } else { a })
    };
    let waves = (0..3).filter_map(best);
    let worth = waves.filter(|(gain, _)| *gain > HUM);
    worth.flat_map(|(_, w)| table::flexible(w)).collect()
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
