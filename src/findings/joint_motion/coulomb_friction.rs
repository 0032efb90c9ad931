//! Dry friction between motor and spring.

use super::balanced;
use super::joint::Joint;
use crate::findings::engine::Member;
use crate::findings::table::{Effect, Place};

/// Shares of the top speed over which friction changes sign.
const SIGN_WIDTHS: [f64; 3] = [0.005, 0.03, 0.1];
/// Share of the top speed below which a joint rests.
const AT_REST: f64 = 0.01;
/// What of the friction of the last motion may hold through a rest.
const HELD: [f64; 2] = [0.6, 1.0];

/// As the engine takes it: one amount is the twist that it takes, rad.
pub(super) const EFFECT: Effect<Joint> = Effect {
    name: "coulomb_friction",
    summary: "Dry friction between motor and spring takes torque that never reaches the link.",
    mechanism: "dry friction",
    places: |joint| {
        let top = joint.data.top_speed().max(f64::MIN_POSITIVE);
        let speed = &joint.data.speed;
        let mut signs = SIGN_WIDTHS
            .map(|w| joint.column(|i| (speed[i] / (w * top)).tanh()))
            .to_vec();
        signs.extend(HELD.map(|held| held_sign(speed, AT_REST * top, held)));
        // the torque jumps with it, and is smoothed
        let smooth: Vec<Vec<f64>> = signs.iter().map(|c| joint.data.smoothed(c)).collect();
        signs.extend(smooth);
        signs.retain(|c| balanced(c, 0.5));
        let members = signs.into_iter().map(|c| Member::free(c).positive());
        vec![Place::new(&joint.site, members.collect())]
    },
    parameters: |_, blamed| vec![("twist", blamed.amounts[0], "rad")],
    would_tell: "reverse the motion slowly at constant load, then change the load at rest: friction of the drive follows the direction of motion",
};

/// Sign of the motion; at rest, so much of that of the last motion.
fn held_sign(speed: &[f64], still: f64, held: f64) -> Vec<f64> {
    let mut last = 0.0;
    let of = |v: &f64| match v.abs() > still {
        true => {
            last = v.signum();
            last
        }
        false => held * last,
    };
    speed.iter().map(of).collect()
}
