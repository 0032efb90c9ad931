//! The dynamometer rings: a resonance of the second order between the force and its reading. Frequencies
//! are tried on a grid, then ever closer about the one that was found.

use super::Case;
use super::revolution::Revolution;
use super::setting::SENSOR;
use crate::findings::engine::Member;
use crate::findings::table::{Effect, Place};
use std::f64::consts::TAU;

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "sensor_resonance",
    summary: "The sensor rings: it magnifies forces near its own frequency.",
    mechanism: "resonance",
    places: |case| {
        let revolutions: Vec<Revolution> = (0..case.cuts().len())
            .map(|c| Revolution::new(&case.cuts()[c].present, case.places(), c, &case.offset))
            .collect();
        vec![Place::new("sensor", members(case, &revolutions))]
    },
    parameters: |_, blamed| {
        let mut told = vec![
            ("frequency", blamed.shape[2], "Hz"),
            ("damping_ratio", blamed.shape[3], "1"),
            ("share", blamed.amounts[0], "1"),
        ];
        if blamed.shape[1] < 3.0 {
            told.push(("axis", blamed.shape[1], "1"));
        }
        told
    },
    would_tell: "strike the sensor with a hammer while the spindle stands",
};

/// Frequencies of the first grid.
const STEPS: usize = 24;
/// Damping ratios there.
const DAMPING: [f64; 2] = [0.02, 0.08];
/// Shares by which it is brought closer, one after the other.
const CLOSER: [f64; 5] = [0.06, 0.03, 0.015, 0.006, 0.003];
/// Steps of the frequency, in these shares.
const STEPS_ABOUT: [f64; 5] = [-2.0, -1.0, 0.0, 1.0, 2.0];
/// Steps of the damping ratio, in these shares.
const SOFTER: [f64; 3] = [-10.0, 0.0, 12.0];
/// All axes.
const ALL: usize = 3;

/// The best of the grid for every axis and for all, brought closer.
fn members(case: &Case, revolutions: &[Revolution]) -> Vec<Member> {
    let grid = grid(case);
    let best = |axis: usize, tried: &[[f64; 2]]| {
        let each = tried
            .iter()
            .map(|at| (*at, fitness(case, revolutions, axis, *at)));
        each.reduce(|a, b| if b.1 > a.1 { b } else { a })
    };
    let mut members = Vec::new();
    for axis in 0..=ALL {
        let Some(mut found) = best(axis, &grid) else {
            continue;
        };
        for width in CLOSER {
            let about = STEPS_ABOUT.iter().flat_map(|f| {
                SOFTER.map(|d| {
                    [
                        found.0[0] * (1.0 + width * f),
                        found.0[1] * (1.0 + d * width).max(0.2),
                    ]
                })
            });
            let about: Vec<[f64; 2]> = about.map(|[hz, d]| [hz, d.clamp(0.002, 0.7)]).collect();
            found = best(axis, &about)
                .filter(|b| b.1 > found.1)
                .unwrap_or(found);
        }
        let shape = [SENSOR, axis as f64, found.0[0], found.0[1]];
        let column = column(case, revolutions, axis, found.0);
        if column.iter().any(|x| *x != 0.0) {
            members.push(Member::free(column).positive().shaped(&shape));
        }
    }
    members
}

fn column(case: &Case, revolutions: &[Revolution], axis: usize, at: [f64; 2]) -> Vec<f64> {
    let rung: Vec<_> = revolutions.iter().map(|r| r.rung(at)).collect();
    case.column(|c, i, k| match axis == ALL || axis == k {
        true => rung[c][i][k],
        false => 0.0,
    })
}

/// How much a resonance explains, where it magnifies.
fn fitness(case: &Case, revolutions: &[Revolution], axis: usize, at: [f64; 2]) -> f64 {
    let column = column(case, revolutions, axis, at);
    match case.aim().amounts(std::slice::from_ref(&column))[0] > 0.0 {
        true => case.aim().gain(&column),
        false => 0.0,
    }
}

fn grid(case: &Case) -> Vec<[f64; 2]> {
    let [low, high] = range(case);
    let hz = |i: usize| low * (high / low).powf(i as f64 / (STEPS - 1) as f64);
    (0..STEPS)
        .flat_map(|i| DAMPING.iter().map(move |d| [hz(i), *d]))
        .collect()
}

/// From the slowest spindle to what the samples can show, Hz.
fn range(case: &Case) -> [f64; 2] {
    let spindles = case
        .cuts()
        .iter()
        .map(|c| c.present.scene.cut.spindle_rad_s / TAU);
    let low = spindles.fold(f64::INFINITY, f64::min);
    let steps = case
        .cuts()
        .iter()
        .flat_map(|c| c.time.windows(2).map(|w| w[1] - w[0]));
    let shortest = steps.fold(f64::INFINITY, f64::min).max(1e-9);
    [1.5 * low, (0.5 / shortest).clamp(3.0 * low, 200.0 * low)]
}
