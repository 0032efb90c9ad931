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
    // no drift is a formula
    law_error: 0.05,
    can_be: |_, _| true,
    places: |case| vec![Place::new("sensor", members(case))],
    parameters: |_, blamed| {
        // every column has come to one at the end; those of one axis follow one another
        let each = blamed.amounts.chunks(blamed.shape[2] as usize);
        let square: f64 = each.map(|own| own.iter().sum::<f64>().powi(2)).sum();
        vec![("drift", square.sqrt(), "N")]
    },
    would_tell: "let the sensor warm up, and repeat the first cut at the end",
};

/// Time constants over the length of the file, alone or two together; 0: in proportion to time. A drift follows no
/// formula: one over the root of time was told as one towards an end beside an offset of the sensor.
const CONSTANTS: [&[f64]; 4] = [&[0.0], &[0.2], &[0.5], &[0.0, 0.1]];

fn members(case: &Case) -> Vec<Member> {
    let axes: [&[usize]; 4] = [&[0], &[1], &[2], &[0, 1, 2]];
    let pairs = CONSTANTS
        .iter()
        .flat_map(|constants| axes.iter().map(move |own| (*constants, *own)));
    pairs
        .map(|(constants, own)| member(case, constants, own))
        .collect()
}

/// How far a drift has come at a share of the file.
fn warm(constant: f64, u: f64) -> f64 {
    match constant {
        0.0 => u,
        c => (1.0 - (-u / c).exp()) / (1.0 - (-1.0 / c).exp()),
    }
}

fn member(case: &Case, constants: &[f64], axes: &[usize]) -> Member {
    let one = |constant: f64, own: usize| {
        case.column(|c, i, k| match k == own {
            true => warm(constant, case.progress(c, i)),
            false => 0.0,
        })
    };
    let each = axes
        .iter()
        .flat_map(|own| constants.iter().map(move |c| one(*c, *own)));
    Member {
        columns: each.collect(),
        size: Size::Free,
        shape: [SENSOR, constants[0], constants.len() as f64]
            .into_iter()
            .chain(axes.iter().map(|k| *k as f64))
            .collect(),
        ..Member::free(Vec::new())
    }
}
