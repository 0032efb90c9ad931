//! The screw grows while it warms up: the error drifts from reading to reading, in proportion to the distance
//! from where the screw is held.

use super::Case;
use crate::findings::engine::Member;
use crate::findings::table::{self, Effect, Place, together, warmed};

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "thermal_growth",
    summary: "The screw grows while it warms up: the error drifts, in proportion to the distance from the fixed bearing.",
    mechanism: "drift",
    law_error: 0.0,
    can_be: |_, _| true,
    places: |case| vec![Place::new("screw", members(case))],
    parameters: |case, blamed| {
        let [growth, shift] = match blamed.shape.len() {
            1 => [blamed.amounts[0], blamed.amounts[1]],
            _ => at_the_end(case, &blamed.part),
        };
        let mut found = match case.temperature_range {
            Some(range) if range > 0.0 => vec![("growth", growth / range, "m/(m·K)")],
            _ => vec![("growth", growth, "m/m")],
        };
        found.push(("shift", shift, "m"));
        found
    },
    would_tell: "record the temperature, or repeat after warming up",
};

/// Time constants over the length of the record; 0: in proportion to it.
const CONSTANTS: [f64; 5] = [0.0, 0.07, 0.15, 0.35, 0.8];
/// Those of a screw whose bodies warm one after the other, fitted together. None so fast that it is a constant but for the first
/// readings: with 0.03 a lead that is wrong was a growth that others take back. No other numbers were
/// tried.
const TOGETHER: [f64; 3] = [0.1, 0.3, 1.0];

fn members(case: &Case) -> Vec<Member> {
    let over_time = CONSTANTS
        .iter()
        .map(|constant| member(case, &case.lapse, &[*constant]));
    let mut members: Vec<Member> = over_time.collect();
    let many = member(case, &case.lapse, &TOGETHER);
    let sized = |m: Member| m.shaped(&TOGETHER);
    members.extend(table::flexible(many.columns).into_iter().map(sized));
    if case.temperature_range.is_some() {
        members.push(member(case, &case.progress, &CONSTANTS[..1]));
    }
    members
}

/// Growth over the lapse of each time constant: about the middle, and a shift, since the screw's fixed end is
/// not known.
fn member(case: &Case, lapse: &[f64], constants: &[f64]) -> Member {
    let two = |constant: &f64| {
        let lever =
            |of: &dyn Fn(usize) -> f64| case.column(|i| of(i) * warmed(lapse[i], *constant));
        [lever(&|i| case.at[i]), lever(&|_| case.half)]
    };
    together(constants.iter().flat_map(two).collect(), constants)
}

/// Growth over the travel and shift, over half of it, in the last fifth of a record.
fn at_the_end(case: &Case, part: &[f64]) -> [f64; 2] {
    let last: Vec<usize> = (0..case.rows()).filter(|i| case.lapse[*i] > 0.8).collect();
    let n = last.len().max(1) as f64;
    let mean = |of: &dyn Fn(usize) -> f64| last.iter().map(|i| of(*i)).sum::<f64>() / n;
    let [at, middle] = [mean(&|i| case.at[i]), mean(&|i| part[i])];
    let along = mean(&|i| (case.at[i] - at) * (part[i] - middle));
    let growth = along / mean(&|i| (case.at[i] - at).powi(2)).max(f64::MIN_POSITIVE);
    [growth, (middle - growth * at) / case.half]
}
