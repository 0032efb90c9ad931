//! An encoder errs periodically over its turn.

use super::joint::Joint;
use super::ripple::Wave;
use crate::findings::engine::Member;
use crate::findings::table::{Effect, Place};

/// As the engine takes it: two amounts are sine and cosine over one period, rad.
pub(super) const EFFECT: Effect<Joint> = Effect {
    name: "encoder_ripple",
    summary: "An encoder errs periodically over its turn.",
    mechanism: "period",
    law_error: 0.0,
    can_be: |_, _| true,
    places: |joint| vec![Place::new(&joint.site, members(joint, true))],
    parameters: |_, blamed| {
        vec![
            (
                "amplitude",
                blamed.amounts[0].hypot(blamed.amounts[1]),
                "rad",
            ),
            ("per_turn_of_the_link", blamed.shape[0], "1"),
        ]
    },
    would_tell: "repeat the motion slower and from another angle: an encoder's error stays where it is on its turn, and as large",
};

/// Periods of the residual that are large, and can be an encoder's own or cannot.
pub(super) fn members(joint: &Joint, of_encoder: bool) -> Vec<Member> {
    let is_wanted = |w: &&Wave| w.of_encoder == of_encoder && !w.is_small;
    let own = joint.waves.iter().filter(is_wanted);
    let member = |wave: &Wave| Member {
        columns: wave.columns.clone(),
        ..Member::free(Vec::new()).shaped(&[wave.order])
    };
    own.map(member).collect()
}
