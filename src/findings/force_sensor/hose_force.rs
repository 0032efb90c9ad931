//! The pull of a hose: a smooth load over the orientation, as the even quadratic of the quaternion (one and
//! the entries of R), on the forces, or on forces and moments.

use super::Case;
use crate::findings::engine::Member;
use crate::findings::table::{Effect, Place};
use crate::inference::gaussian::Size;
use crate::measurement::force_sensor::matrix;

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "hose_force",
    summary: "A hose or cable pulls on the tool, smoothly over the orientation.",
    mechanism: "hose",
    places: |case| vec![Place::new("tool", members(case))],
    parameters: |case, blamed| {
        let per = blamed.amounts.len() / blamed.shape.len().max(1);
        let rms = |channel: usize| {
            let own = &blamed.amounts[channel * per..(channel + 1) * per];
            let at = |i: usize| {
                entries(case, i)
                    .iter()
                    .zip(own)
                    .map(|(e, a)| e * a)
                    .sum::<f64>()
            };
            let n = case.test.readings.len();
            ((0..n).map(|i| at(i).powi(2)).sum::<f64>() / n as f64).sqrt()
        };
        let forces = blamed.shape.iter().enumerate().filter(|(_, c)| **c < 3.0);
        let square: f64 = forces.map(|(k, _)| rms(k).powi(2)).sum();
        vec![("force_rms", square.sqrt(), "N")]
    },
    would_tell: "take the hose off and repeat",
};

/// The nine entries of R at a reading.
fn entries(case: &Case, i: usize) -> Vec<f64> {
    matrix(case.test.readings[i].quaternion)
        .as_flattened()
        .to_vec()
}

fn members(case: &Case) -> Vec<Member> {
    let member = |channels: &[usize]| {
        let one = |own: usize, k: usize| {
            case.column(|i, c| if c == own { entries(case, i)[k] } else { 0.0 })
        };
        Member {
            columns: channels
                .iter()
                .flat_map(|own| (0..9).map(move |k| one(*own, k)))
                .collect(),
            size: Size::Free,
            positive: None,
            shape: channels.iter().map(|c| *c as f64).collect(),
        }
    };
    match case.test.readings.len() {
        0..12 => Vec::new(),
        _ => vec![member(&[0, 1, 2]), member(&[0, 1, 2, 3, 4, 5])],
    }
}
