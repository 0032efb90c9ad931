//! The zero of the sensor drifts during the test.

use super::Case;
use crate::findings::engine::Member;
use crate::findings::table::{Effect, Place};
use crate::inference::gaussian::Size;

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "thermal_drift",
    summary: "The zero of the sensor drifts during the test.",
    mechanism: "drift",
    places: |case| vec![Place::new("sensor", members(case))],
    parameters: |_, blamed| {
        let forces = blamed.shape[1..]
            .iter()
            .zip(&blamed.amounts)
            .filter(|(c, _)| **c < 3.0);
        let square: f64 = forces.map(|(_, a)| a * a).sum();
        vec![("drift", square.sqrt(), "N")]
    },
    would_tell: "let the sensor warm up, and repeat the first orientation at the end",
};

/// Time constants over the length of the test; 0: in proportion to time.
const CONSTANTS: [f64; 3] = [0.0, 0.2, 0.5];

fn members(case: &Case) -> Vec<Member> {
    let channels: [&[usize]; 5] = [&[0], &[1], &[2], &[0, 1, 2], &[0, 1, 2, 3, 4, 5]];
    let pairs = CONSTANTS
        .iter()
        .flat_map(|constant| channels.iter().map(move |own| (*constant, *own)));
    pairs
        .map(|(constant, own)| member(case, constant, own))
        .collect()
}

fn member(case: &Case, constant: f64, channels: &[usize]) -> Member {
    let warm = |u: f64| match constant {
        0.0 => u,
        c => (1.0 - (-u / c).exp()) / (1.0 - (-1.0 / c).exp()),
    };
    let one = |own: usize| {
        case.column(|i, c| {
            if c == own {
                warm(case.progress[i])
            } else {
                0.0
            }
        })
    };
    Member {
        columns: channels.iter().map(|own| one(*own)).collect(),
        size: Size::Free,
        positive: None,
        shape: [constant]
            .into_iter()
            .chain(channels.iter().map(|c| *c as f64))
            .collect(),
    }
}
