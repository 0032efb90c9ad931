//! One axis of the dynamometer reads too much or too little, or all by the same share: which is also what
//! other coefficients would do, all six together.

use super::Case;
use super::setting::SENSOR;
use crate::findings::engine::{Blamed, Member};
use crate::findings::table::{Effect, Place};
use crate::ground::spatial::M3;

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "force_gain",
    summary: "The sensor reads too much or too little.",
    mechanism: "calibration",
    law_error: 0.02,
    can_be: |_, _| true,
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

/// What a gain adds to forces.
pub(super) fn map(blamed: &Blamed) -> Option<M3> {
    if blamed.effect != EFFECT.name {
        return None;
    }
    let (first, count) = (blamed.shape[1] as usize, blamed.shape[2] as usize);
    let mut map = [[0.0; 3]; 3];
    (first..first + count).for_each(|k| map[k][k] = blamed.amounts[0]);
    Some(map)
}

fn member(case: &Case, axes: &[usize]) -> Member {
    let mut map = [[0.0; 3]; 3];
    axes.iter().for_each(|k| map[*k][*k] = 1.0);
    let column = case.aim().mapped(case, &map);
    Member::free(column).shaped(&[SENSOR, axes[0] as f64, axes.len() as f64])
}
