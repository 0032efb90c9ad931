//! The screw grows while it warms up: the error drifts from reading to reading, in proportion to the distance
//! from where the screw is held.

use super::Case;
use crate::findings::engine::Member;
use crate::findings::table::{Effect, Place};
use crate::inference::gaussian::Size;

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "thermal_growth",
    summary: "The screw grows while it warms up: the error drifts, in proportion to the distance from the fixed bearing.",
    mechanism: "drift",
    places: |case| vec![Place::new("screw", members(case))],
    parameters: |case, blamed| {
        let mut found = match case.temperature_range {
            Some(range) if range > 0.0 => vec![("growth", blamed.amounts[0] / range, "m/(m·K)")],
            _ => vec![("growth", blamed.amounts[0], "m/m")],
        };
        found.push(("shift", blamed.amounts[1], "m"));
        found
    },
    would_tell: "record the temperature, or repeat after warming up",
};

/// Time constants over the length of the record; 0: in proportion to it.
const CONSTANTS: [f64; 4] = [0.0, 0.15, 0.35, 0.8];

fn members(case: &Case) -> Vec<Member> {
    let constants = if case.temperature_range.is_some() {
        &CONSTANTS[..1]
    } else {
        &CONSTANTS[..]
    };
    constants
        .iter()
        .map(|constant| member(case, *constant))
        .collect()
}

fn member(case: &Case, constant: f64) -> Member {
    let warm = |u: f64| match constant {
        0.0 => u,
        c => (1.0 - (-u / c).exp()) / (1.0 - (-1.0 / c).exp()),
    };
    // the screw's fixed end is not known: growth about the middle, and a shift
    let columns = vec![
        case.column(|i| case.at[i] * warm(case.progress[i])),
        case.column(|i| case.half * warm(case.progress[i])),
    ];
    Member {
        columns,
        size: Size::Free,
        positive: None,
        shape: vec![constant],
    }
}
