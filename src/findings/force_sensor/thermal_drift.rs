//! The zero of the sensor drifts during the test.

use super::Case;
use crate::findings::engine::Member;
use crate::findings::table::{self, Effect, Place, together, warmed};

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "thermal_drift",
    summary: "The zero of the sensor drifts during the test.",
    mechanism: "drift",
    // what its shapes miss of any drift
    law_error: 0.06,
    can_be: |_, _| true,
    places: |case| vec![Place::new("sensor", members(case))],
    parameters: |case, blamed| {
        // from the first reading to the last
        let last = case.test.readings.len().saturating_sub(1);
        let way = |c: usize| blamed.part[6 * last + c] - blamed.part[c];
        let square: f64 = (0..3).map(|c| way(c).powi(2)).sum();
        vec![("drift", square.sqrt(), "N")]
    },
    would_tell: "let the sensor warm up, and repeat the first orientation at the end",
};

/// Time constants over the length of the test; 0: in proportion to time.
const CONSTANTS: [f64; 3] = [0.0, 0.2, 0.5];
/// Those of a sensor whose parts warm one after the other, fitted together.
const TOGETHER: [f64; 3] = [0.1, 0.3, 1.0];

fn members(case: &Case) -> Vec<Member> {
    let channels: [&[usize]; 5] = [&[0], &[1], &[2], &[0, 1, 2], &[0, 1, 2, 3, 4, 5]];
    let pairs = CONSTANTS
        .iter()
        .flat_map(|constant| channels.iter().map(move |own| (*constant, *own)));
    let single = pairs.map(|(constant, own)| member(case, constant, own));
    let all = TOGETHER
        .iter()
        .flat_map(|constant| member(case, *constant, channels[4]).columns);
    let many = table::flexible(all.collect());
    single
        .chain(many.into_iter().map(|m| m.shaped(&[TOGETHER[0]])))
        .collect()
}

fn member(case: &Case, constant: f64, channels: &[usize]) -> Member {
    let one = |own: usize| {
        case.column(|i, c| match c == own {
            true => warmed(case.progress[i], constant),
            false => 0.0,
        })
    };
    let columns = channels.iter().map(|own| one(*own)).collect();
    let channels = channels.iter().map(|c| *c as f64);
    let shape: Vec<f64> = std::iter::once(constant).chain(channels).collect();
    together(columns, &shape)
}
