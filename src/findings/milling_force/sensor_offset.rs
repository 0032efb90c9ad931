//! The sensor reads something where there is nothing: on one axis, or on all.

use super::Case;
use super::force_gain::SITES;
use super::setting::SENSOR;
use crate::findings::engine::Member;
use crate::findings::table::{Effect, Place};
use crate::inference::gaussian::Size;

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "sensor_offset",
    summary: "The sensor reads a constant where there is no force.",
    mechanism: "offset",
    law_error: 0.0,
    can_be: |_, _| true,
    places: |case| {
        let axes = (0..3).map(|k| Place::new(SITES[k], vec![member(case, &[k])]));
        let all = Place::new("sensor", vec![member(case, &[0, 1, 2])]);
        axes.chain([all]).collect()
    },
    parameters: |case, blamed| {
        const NAMES: [&str; 3] = ["offset_fx", "offset_fy", "offset_fz"];
        let own = blamed.shape[1..].iter().zip(&blamed.amounts);
        own.map(|(k, amount)| (NAMES[*k as usize], case.sign() * amount, "N"))
            .collect()
    },
    would_tell: "read the sensor before and after the cut",
};

fn member(case: &Case, axes: &[usize]) -> Member {
    let one = |own: &usize| case.column(|_, _, k| f64::from(u8::from(k == *own)));
    Member {
        columns: axes.iter().map(one).collect(),
        size: Size::Free,
        shape: [SENSOR]
            .into_iter()
            .chain(axes.iter().map(|k| *k as f64))
            .collect(),
        ..Member::free(Vec::new())
    }
}
