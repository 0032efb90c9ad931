//! The zero of the sensor drifts during the file: in proportion to time, or towards an end.

use super::Case;
use super::setting::SENSOR;
use crate::findings::engine::Member;
use crate::findings::table::{Effect, Place};
use crate::inference::gaussian::Size;

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "thermal_drift",
    summary: "The zero of the sensor drifts during the cuts.",
    mechanism: "drift",
    places: |case| vec![Place::new("sensor", members(case))],
    parameters: |_, blamed| {
        let square: f64 = blamed.amounts.iter().map(|a| a * a).sum();
        vec![("drift", square.sqrt(), "N")]
    },
    would_tell: "let the sensor warm up, and repeat the first cut at the end",
};

/// Time constants over the length of the file; 0: in proportion to time.
const CONSTANTS: [f64; 3] = [0.0, 0.2, 0.5];

fn members(case: &Case) -> Vec<Member> {
    let axes: [&[usize]; 4] = [&[0], &[1], &[2], &[0, 1, 2]];
    let pairs = CONSTANTS
        .iter()
        .flat_map(|constant| axes.iter().map(move |own| (*constant, *own)));
    pairs
        .map(|(constant, own)| member(case, constant, own))
        .collect()
}

fn member(case: &Case, constant: f64, axes: &[usize]) -> Member {
    let warm = |u: f64| match constant {
        0.0 => u,
        c => (1.0 - (-u / c).exp()) / (1.0 - (-1.0 / c).exp()),
    };
    let one = |own: &usize| {
        case.column(|c, i, k| match k == *own {
            true => warm(case.progress(c, i)),
            false => 0.0,
        })
    };
    Member {
        columns: axes.iter().map(one).collect(),
        size: Size::Free,
        positive: None,
        shape: [SENSOR, constant]
            .into_iter()
            .chain(axes.iter().map(|k| *k as f64))
            .collect(),
    }
}
