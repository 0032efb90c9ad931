//! Dry friction between motor and spring.

use super::balanced;
use super::joint::Joint;
use super::presliding::dahl;
use crate::findings::engine::Member;
use crate::findings::table::{Effect, Place};

/// Shares of the top speed over which friction changes sign.
const SIGN_WIDTHS: [f64; 3] = [0.005, 0.03, 0.1];
/// Share of the top speed below which a joint rests.
const AT_REST: f64 = 0.01;
/// What of the friction of the last motion may hold through a rest.
const HELD: [f64; 2] = [0.6, 1.0];

/// Motion of the link over which it builds up, rad ...
const REACHES: [f64; 5] = [2e-4, 5e-4, 1.2e-3, 3e-3, 8e-3];
/// ... what holds before the record, ...
const BEGINS: [f64; 3] = [0.0, -1.0, 1.0];
/// ... and by how much it is greater below which share of the top speed (Stribeck 1902).
const STICTION: [(f64, f64); 5] = [
    (0.0, 1.0),
    (0.15, 0.03),
    (0.15, 0.1),
    (0.4, 0.03),
    (0.4, 0.1),
];

/// Share of the readings in which a joint must move either way: motion in one direction alone makes friction a zero.
const SELDOM: f64 = 0.04;

/// As the engine takes it: one amount is the twist that it takes, rad.
pub(super) const EFFECT: Effect<Joint> = Effect {
    name: "coulomb_friction",
    summary: "Dry friction between motor and spring takes torque that never reaches the link.",
    mechanism: "dry friction",
    law_error: 0.0,
    can_be: |_, _| true,
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
        signs.extend(built_up(joint));
        signs.retain(|c| balanced(c, 0.5, SELDOM));
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

/// Friction that builds up after a reversal and is greater in slow motion.
fn built_up(joint: &Joint) -> Vec<Vec<f64>> {
    let data = &joint.data;
    let top = data.top_speed().max(f64::MIN_POSITIVE);
    let mut columns = Vec::new();
    for (reach, begin) in REACHES.iter().flat_map(|r| BEGINS.map(|b| (*r, b))) {
        let held = dahl(&data.motor, reach, begin);
        columns.extend(STICTION.map(|(more, slow)| {
            let stick = |i: usize| more * (-(data.speed[i] / (slow * top)).powi(2)).exp();
            data.smoothed(&joint.column(|i| held[i] * (1.0 + stick(i))))
        }));
    }
    columns
}
