//! The encoders are not read at the same instant.

use super::joint::Joint;
use crate::findings::engine::{Blamed, Member};
use crate::findings::table::{Effect, Place};

/// As the engine takes it: one amount is the link encoder's delay, s.
pub(super) const EFFECT: Effect<Joint> = Effect {
    name: "time_skew",
    summary: "The encoders of motor and link are not read at the same instant.",
    mechanism: "instants",
    law_error: 0.0,
    can_be: |_, _| true,
    places: |joint| {
        let late = joint.column(|i| -joint.data.speed[i]);
        match joint.data.top_speed() > 0.0 {
            true => vec![Place::new(&joint.site, vec![Member::free(late)])],
            false => Vec::new(),
        }
    },
    parameters: |joint, blamed: &Blamed| {
        let delay = blamed.amounts[0] + joint.declared.unwrap_or(0.0);
        vec![("delay", delay, "s")]
    },
    would_tell: "repeat the motion at half the speed, and at two constant speeds with and without payload: what a delay adds follows the speed alone",
};
