//! One axis of the dynamometer reads too much or too little, or all by the same share: which is also what
//! other coefficients would do, all six together.

use super::Case;
use super::setting::SENSOR;
use crate::findings::engine::Member;
use crate::findings::table::{Effect, Place};

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "force_gain",
    summary: "The sensor reads too much or too little.",
    mechanism: "calibration",
    places: |case| {
        let axes = (0..3).map(|k| Place::new(SITES[k], vec![member(case, &[k])]));
        let all = Place::new("sensor", vec![member(case, &[0, 1, 2])]);
        let seen = |place: &Place| place.members[0].columns[0].iter().any(|x| *x != 0.0);
        axes.chain([all]).filter(seen).collect()
    },
    parameters: |_, blamed| vec![("gain_error", blamed.amounts[0], "1")],
    would_tell: "put a known force on the sensor along all axes",
};

/// Sites of the axes.
pub(super) const SITES: [&str; 3] = ["sensor-x", "sensor-y", "sensor-z"];

fn member(case: &Case, axes: &[usize]) -> Member {
    let gain = |c: usize, i: usize, k: usize| match axes.contains(&k) {
        true => case.simulated(c, i)[k],
        false => 0.0,
    };
    Member::free(case.column(gain)).shaped(&[SENSOR, axes[0] as f64, axes.len() as f64])
}
