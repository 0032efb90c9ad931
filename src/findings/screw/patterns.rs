//! Errors that no cause of the library has. They compete with the causes and are never named: where one of them
//! is at work, the cause is unknown, and this is what is seen.

use super::Case;
use crate::findings::engine::Member;
use crate::findings::table::{self, Pattern, together};
use std::f64::consts::TAU;

/// All of them.
pub(super) const PATTERNS: &[Pattern<Case>] = &[
    Pattern {
        name: "period",
        summary: "an error over the travel with a period that is not the screw's",
        members: periods,
    },
    Pattern {
        name: "course",
        summary: "an error that changes smoothly over the travel",
        members: courses,
    },
    Pattern {
        name: "ways",
        summary: "the ways forth and back differ, and not by the same everywhere",
        members: ways,
    },
    Pattern {
        name: "change",
        summary: "an error that changes with time, and not as a screw that grows",
        members: changes,
    },
];

/// Waves over the travel that a pattern is made of, at most.
const WAVES: usize = 12;
/// Least wave over the travel, in turns.
const SLOWEST: f64 = 0.75;
/// Turns over the travel by which tried waves differ: a quarter is hardly told from its neighbour.
const STEP: f64 = 0.25;
/// Turns over the travel within which a wave is the screw's own.
const OWN: f64 = 0.5;
/// Most waves that are tried.
const MOST: f64 = 60.0;

/// Waves of one period, from the longest that is no slope up to two targets each, but those of the screw.
fn periods(case: &Case) -> Vec<Member> {
    let travel = 2.0 * case.half;
    let fastest = (0.5 * (case.targets() as f64 - 1.0)).min(MOST);
    let own = |turns: f64| {
        let per_turn = case.test.facts.pitch.map(|pitch| travel / pitch);
        per_turn.is_some_and(|p| (1..=3).any(|h| (turns - f64::from(h) * p).abs() < OWN))
    };
    let count = ((fastest - SLOWEST) / STEP).max(0.0) as i32;
    let turns = (0..=count).map(|k| SLOWEST + STEP * f64::from(k));
    let wave = |turns: f64| {
        let angle = |i: usize| TAU * turns * case.at[i] / travel;
        together(
            vec![
                case.column(|i| angle(i).sin()),
                case.column(|i| angle(i).cos()),
            ],
            &[travel / turns],
        )
    };
    turns.filter(|t| !own(*t)).map(wave).collect()
}

fn courses(case: &Case) -> Vec<Member> {
    let count = (case.targets() / 2).min(WAVES);
    table::flexible(table::waves(&table::unit_range(&case.at), count))
}

fn ways(case: &Case) -> Vec<Member> {
    if !case.both_ways() {
        return Vec::new();
    }
    let count = (case.targets() / 2).min(WAVES);
    let waves = table::waves(&table::unit_range(&case.at), count);
    let sided = waves
        .iter()
        .map(|w| case.column(|i| w[i] * 2.0 * case.side[i]));
    table::flexible(sided.collect())
}

/// Waves over the time, alone and in proportion to the travel.
fn changes(case: &Case) -> Vec<Member> {
    let waves = table::waves(&case.lapse, WAVES / 2);
    let along = waves
        .iter()
        .map(|w| case.column(|i| w[i] * case.at[i] / case.half));
    let all: Vec<Vec<f64>> = waves.iter().cloned().chain(along).collect();
    table::flexible(all)
}
