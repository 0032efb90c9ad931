//! Loads that no cause of the library has. They compete with the causes and are never named.

use super::Case;
use crate::findings::engine::Member;
use crate::findings::table::{self, Pattern, together};

/// All of them.
pub(super) const PATTERNS: &[Pattern<Case>] = &[
    Pattern {
        name: "jump",
        summary: "the zeros jump once during the test",
        members: jumps,
    },
    Pattern {
        name: "course",
        summary: "the zeros wander during the test, and not as a sensor that warms up",
        members: courses,
    },
    Pattern {
        name: "bend",
        summary: "a channel is not in proportion to its load",
        members: bends,
    },
    Pattern {
        name: "direction",
        summary: "a load over the direction of the weight that no rigid tool and no straight sensor makes",
        members: directions,
    },
];

/// All zeros from a point on, but the first and the last, which are outliers.
fn jumps(case: &Case) -> Vec<Member> {
    let count = case.points.1.len();
    let from = |point: usize| {
        let channel = |own: usize| {
            case.column(|i, c| f64::from(u8::from(c == own && case.points.0[i] >= point)))
        };
        together((0..6).map(channel).collect(), &[point as f64])
    };
    (2..count.saturating_sub(1)).map(from).collect()
}

/// Waves over the test that a pattern is made of.
const WAVES: usize = 5;

fn courses(case: &Case) -> Vec<Member> {
    let waves = table::waves(&case.progress, WAVES.min(case.points.1.len() / 2));
    let channel = |own: usize| {
        let one = move |wave: &Vec<f64>| case.column(|i, c| if c == own { wave[i] } else { 0.0 });
        waves.iter().map(one).collect::<Vec<_>>()
    };
    let all: Vec<Vec<f64>> = (0..6).flat_map(channel).collect();
    let forces: Vec<Vec<f64>> = (0..3).flat_map(channel).collect();
    [all, forces]
        .into_iter()
        .flat_map(table::flexible)
        .collect()
}

/// One channel over the square of its load, that keeps its sign or does not, and over its third power.
fn bends(case: &Case) -> Vec<Member> {
    let largest = |own: usize| {
        let all = (0..case.test.readings.len()).map(|i| case.load(i, own).abs());
        all.fold(f64::MIN_POSITIVE, f64::max)
    };
    let bend = |own: usize| {
        let most = largest(own);
        let power = |of: fn(f64) -> f64| {
            case.column(|i, c| {
                if c == own {
                    most * of(case.load(i, own) / most)
                } else {
                    0.0
                }
            })
        };
        let powers: [fn(f64) -> f64; 3] = [|x| x * x, |x| x * x.abs(), |x| x.powi(3)];
        together(powers.map(power).to_vec(), &[own as f64])
    };
    (0..6)
        .map(bend)
        .filter(|m| m.columns[0].iter().any(|x| *x != 0.0))
        .collect()
}

/// Any force, or any moment, over the direction of the weight, by the second and third powers of its components.
fn directions(case: &Case) -> Vec<Member> {
    let n = case.test.readings.len();
    let weight = (0..n).map(|i| (0..3).map(|c| case.load(i, c).powi(2)).sum::<f64>().sqrt());
    let most = weight.fold(f64::MIN_POSITIVE, f64::max);
    let powers = (0..=3_i32)
        .flat_map(|a| (0..=3 - a).flat_map(move |b| (0..=3 - a - b).map(move |c| [a, b, c])));
    // one component squared follows from the other two
    let powers: Vec<[i32; 3]> = powers
        .filter(|p| p[2] < 2 && p.iter().sum::<i32>() > 1)
        .collect();
    let value = |i: usize, p: &[i32; 3]| {
        (0..3)
            .map(|k| (case.load(i, k) / most).powi(p[k]))
            .product::<f64>()
    };
    let any = |channels: std::ops::Range<usize>| {
        let each = channels.flat_map(|own| powers.iter().map(move |p| (own, p)));
        let column = |(own, p): (usize, &[i32; 3])| {
            case.column(|i, c| if c == own { value(i, p) } else { 0.0 })
        };
        table::flexible(each.map(column).collect())
    };
    match case.points.1.len() {
        0..12 => Vec::new(),
        _ => [any(0..3), any(3..6)].concat(),
    }
}
