//! A free gap in the gear: the twist jumps where the torque changes sign.

use super::balanced;
use super::channels::largest;
use super::joint::Joint;
use crate::findings::engine::Member;
use crate::findings::table::{Effect, Place};
use crate::signal::play::play;

/// Shares of the largest torque over which a gap closes.
const WIDTHS: [f64; 9] = [0.003, 0.005, 0.008, 0.013, 0.02, 0.032, 0.05, 0.08, 0.15];
/// Shares of the largest torque that hold a link where it is while it is loose.
const HELD: [f64; 3] = [0.02, 0.05, 0.1];
/// Share of the largest torque that must be passed to either side, and of the readings in which it must be: a gap shows
/// where the torque passes zero, however briefly.
const BOTH_WAYS: f64 = 0.02;
const SELDOM: f64 = 0.01;

/// As the engine takes it: one amount is half the gap, rad.
pub(super) const EFFECT: Effect<Joint> = Effect {
    name: "backlash",
    summary: "A free gap in the gear: the link is loose while the torque changes sign.",
    mechanism: "contact",
    law_error: 0.0,
    can_be: |_, _| true,
    places: |joint| {
        let transmitted = joint.friction.less(&joint.data, &joint.geared);
        let scale = largest(&joint.geared);
        let torques = [&joint.geared, &transmitted];
        let both = torques
            .into_iter()
            .filter(|t| balanced(t, BOTH_WAYS * scale, SELDOM));
        let columns = both.flat_map(|t| {
            let held = HELD.map(|h| step(&play(t, h * scale), WIDTHS[0]));
            let steps = WIDTHS.iter().flat_map(|w| [step(t, *w), soft(t, *w)]);
            steps.chain(held).collect::<Vec<_>>()
        });
        let members = columns.map(|c| Member::free(c).positive());
        vec![Place::new(&joint.site, members.collect())]
    },
    parameters: |_, blamed| vec![("gap", 2.0 * blamed.amounts[0], "rad")],
    would_tell: "let the torque pass zero slowly, once with and once without reversing the motion: a gap follows the sign of the torque, friction that of the speed",
};

/// Twist by a gap that closes over this share of the largest torque.
pub(super) fn step(torque: &[f64], width: f64) -> Vec<f64> {
    let closes = (width * largest(torque)).max(f64::MIN_POSITIVE);
    torque.iter().map(|t| -(t / closes).tanh()).collect()
}

/// Twist by a gap whose flanks come into contact one after the other.
fn soft(torque: &[f64], width: f64) -> Vec<f64> {
    let closes = (width * largest(torque)).max(f64::MIN_POSITIVE);
    let of = |t: &f64| -(t / closes).atan() * std::f64::consts::FRAC_2_PI;
    torque.iter().map(of).collect()
}
