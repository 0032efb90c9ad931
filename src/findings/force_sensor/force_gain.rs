//! One axis of the sensor reads too much or too little: its force, or its force and moment.

use super::Case;
use crate::findings::engine::{Blamed, Member};
use crate::findings::table::{Effect, Place};

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "force_gain",
    summary: "One axis of the sensor reads too much or too little.",
    mechanism: "calibration",
    law_error: 0.0,
    can_be: |_, _| true,
    places: |case| {
        (0..3)
            .map(|k| Place::new(["sensor-x", "sensor-y", "sensor-z"][k], members(case, k)))
            .collect()
    },
    parameters: |_, blamed| vec![("gain_error", blamed.amounts[0], "1")],
    would_tell: "hang a known weight on the sensor in all directions",
};

/// The channels that a gain was found on.
pub(super) fn axes(blamed: &Blamed) -> impl Iterator<Item = usize> {
    let first = ["sensor-x", "sensor-y", "sensor-z"]
        .iter()
        .position(|s| *s == blamed.site);
    let both = blamed.shape.first() == Some(&1.0);
    first
        .into_iter()
        .flat_map(move |k| [Some(k), both.then_some(k + 3)])
        .flatten()
}

fn members(case: &Case, axis: usize) -> Vec<Member> {
    let own = |both: bool| {
        case.column(|i, c| {
            if c == axis || (both && c == axis + 3) {
                case.load(i, c)
            } else {
                0.0
            }
        })
    };
    vec![
        Member::free(own(false)),
        Member::free(own(true)).shaped(&[1.0]),
    ]
}
