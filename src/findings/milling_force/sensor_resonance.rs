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
/// Steps of the frequency about the one that was found, up and down.
const CLOSER: [f64; 7] = [0.92, 0.96, 0.985, 1.0, 1.015, 1.04, 1.08];
/// Factors of the damping ratio there.
const SOFTER: [f64; 3] = [0.6, 1.0, 1.6];
/// All axes.
const ALL: usize = 3;

fn members(case: &Case, revolutions: &[Revolution]) -> Vec<Member> {
    let mut members = Vec::new();
    for at in grid(case) {
        let rung: Vec<_> = revolutions.iter().map(|r| r.rung(at)).collect();
        for axis in 0..=ALL {
            let column = case.column(|c, i, k| match axis == ALL || axis == k {
                true => rung[c][i][k],
                false => 0.0,
            });
            if column.iter().any(|x| *x != 0.0) {
                let shape = [SENSOR, axis as f64, at[0], at[1]];
                members.push(Member::free(column).positive().shaped(&shape));
            }
        }
    }
    members
}

fn grid(case: &Case) -> Vec<[f64; 2]> {
    if let Some([hz, damping]) = case.resonance {
        let each = CLOSER.iter().flat_map(|f| SOFTER.iter().map(move |d| (f, d)));
        return each.map(|(f, d)| [hz * f, (damping * d).min(0.7)]).collect();
    }
    let [low, high] = range(case);
    let hz = |i: usize| low * (high / low).powf(i as f64 / (STEPS - 1) as f64);
    (0..STEPS)
        .flat_map(|i| DAMPING.iter().map(move |d| [hz(i), *d]))
        .collect()
}

/// From the slowest spindle to what the samples can show, Hz.
fn range(case: &Case) -> [f64; 2] {
    let spindles = case.cuts().iter().map(|c| c.present.scene.cut.spindle_rad_s / TAU);
    let low = spindles.fold(f64::INFINITY, f64::min);
    let steps = case.cuts().iter().flat_map(|c| c.time.windows(2).map(|w| w[1] - w[0]));
    let shortest = steps.fold(f64::INFINITY, f64::min).max(1e-9);
    [1.5 * low, (0.5 / shortest).clamp(3.0 * low, 200.0 * low)]
}
