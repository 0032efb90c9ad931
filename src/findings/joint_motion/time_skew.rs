//! The encoders are not read at the same instant.

use super::joint::Joint;
use crate::findings::engine::{Blamed, Member};
use crate::findings::table::{Effect, Place, unit_range};

/// As the engine takes it: one amount is the link encoder's delay, s, and, where two clocks run apart, another what is added to it over
/// the record.
pub(super) const EFFECT: Effect<Joint> = Effect {
    name: "time_skew",
    summary: "The encoders of motor and link are not read at the same instant.",
    mechanism: "instants",
    law_error: 0.0,
    can_be: |_, _| true,
    places: |joint| {
        let late = joint.column(|i| -joint.data.speed[i]);
        let through = unit_range(&joint.data.time);
        let later = joint.column(|i| late[i] * (through[i] - 0.5));
        let mut drifting = Member::free(late.clone());
        drifting.columns.push(later);
        match joint.data.top_speed() > 0.0 {
            true => vec![Place::new(&joint.site, vec![Member::free(late), drifting])],
            false => Vec::new(),
        }
    },
    parameters: |joint, blamed: &Blamed| {
        let delay = blamed.amounts[0] + joint.declared.unwrap_or(0.0);
        let mut all = vec![("delay", delay, "s")];
        if drifts(blamed) {
            let time = &joint.data.time;
            let rate = blamed.amounts[1] / (time[time.len() - 1] - time[0]);
            all.push(("clock_rate", rate, "s/s"));
        }
        all
    },
    would_tell: "repeat the motion at half the speed, and at two constant speeds with and without payload: what a delay adds follows the speed alone",
};

/// Whether two clocks run apart, so that the delay is that of the middle of the record.
pub(super) fn drifts(blamed: &Blamed) -> bool {
    blamed.effect == EFFECT.name && blamed.amounts.len() > 1
}
