//! The torque must belong to the motion.

use super::{Moving, Rule};
use crate::fit::suitability::channel::sum;
use crate::fit::suitability::{Said, Weight};
use crate::ground::stats::largest;

/// Friction, inertia and weight tie a torque to the motion; noise and other channels are not.
pub const RULE: Rule = Rule {
    name: "unrelated",
    remedy: "check which channel was recorded as torque, and that all are on one clock",
    look,
};

/// Share of the torque's squares that motion describes.
const SHARE: f64 = 0.2;

fn look(on: &Moving) -> Said {
    let [motor, _, torque, speed] = on.joint.thinned();
    let n = speed.len();
    let slope = |i: usize| speed[(i + 1).min(n - 1)] - speed[i.saturating_sub(1)];
    let top = largest(&speed);
    let columns = [
        (0..n).map(slope).collect(),
        speed
            .iter()
            .map(|v| (20.0 * v / top.max(1e-12)).tanh())
            .collect(),
        motor.iter().map(|q| q.sin()).collect(),
        motor.iter().map(|q| q.cos()).collect(),
        speed.clone(),
        motor,
    ];
    match sum(&torque, &columns) {
        Some(found) if found.share < SHARE => vec![(
            Weight::Fatal,
            format!(
                "the motor torque does not follow the motion ({:.0} % of it does)",
                100.0 * found.share.max(0.0)
            ),
        )],
        _ => Vec::new(),
    }
}
