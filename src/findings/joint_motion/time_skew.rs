//! The encoders are not read at the same instant.

use super::joint::Joint;
use crate::findings::engine::{Blamed, Member};
use crate::findings::table::{Effect, Place, unit_range};

/// As the engine takes it: one amount is the link encoder's delay, s; where two clocks run apart, at the end of the record.
pub(super) const EFFECT: Effect<Joint> = Effect {
    name: "time_skew",
    summary: "The encoders of motor and link are not read at the same instant, or by clocks that run apart.",
    mechanism: "instants",
    law_error: 0.0,
    can_be: |_, _| true,
    places: |joint| {
        let late = joint.column(|i| -joint.data.speed[i]);
        let through = unit_range(&joint.data.time);
        let later = joint.column(|i| late[i] * through[i]);
        let growing = Member::free(later).shaped(&[GROWS]);
        match joint.data.top_speed() > 0.0 {
            true => vec![Place::new(&joint.site, vec![Member::free(late), growing])],
            false => Vec::new(),
        }
    },
    parameters: |joint, blamed: &Blamed| {
        let declared = joint.declared.unwrap_or(0.0);
        if !grows(blamed) {
            return vec![("delay", blamed.amounts[0] + declared, "s")];
        }
        let time = &joint.data.time;
        let rate = blamed.amounts[0] / (time[time.len() - 1] - time[0]);
        let middle = 0.5 * blamed.amounts[0] + declared;
        vec![("delay", middle, "s"), ("clock_rate", rate, "s/s")]
    },
    would_tell: "repeat the motion at half the speed, and at two constant speeds with and without payload: what a delay adds follows the speed alone; and read both by one clock",
};

/// Shape of a delay that grows from none.
const GROWS: f64 = 1.0;

/// Whether two clocks run apart from the start of the record: the delay that is told is then that of its middle.
pub(super) fn grows(blamed: &Blamed) -> bool {
    blamed.effect == EFFECT.name && blamed.shape == [GROWS]
}
