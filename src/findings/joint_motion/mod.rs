//! Motion of joints with an encoder on either side of the gear.
//!
//! The difference of the encoders is torsion under the torque transmitted, and whatever the
//! instruments add. Every joint is an experiment of the common engine ([`crate::findings::engine`]): channels
//! (averaged, smoothed) → what the torque shows of friction, which periods and jumps the twist suggests → noise (its
//! colour) → statement. Its own are the scales, which no column tells: a stiffness (`stiffness`) where every
//! piece of the record and every account agree on it, and the constant zero.

mod backlash;
mod begun;
mod channels;
mod coulomb_friction;
mod delay;
mod diagnosis;
mod encoder_ripple;
mod experiment;
mod finding;
mod friction;
mod gear_torque;
mod hysteresis;
mod joint;
mod jumps;
mod missed;
mod noise;
mod orders;
mod patterns;
mod presliding;
mod presumed;
mod projection;
mod remarks;
mod ripple;
mod scales;
mod sensor_offset;
mod stiffness;
mod time_skew;
mod torque_scatter;
mod viscous_friction;

pub use channels::Channels;
pub use diagnosis::{MotionDiagnosis, diagnose};
pub use experiment::judgement;
pub use finding::JointFinding;
pub use joint::Joint;

use super::table::Effect;

/// Every effect of this kind.
pub const EFFECTS: &[Effect<Joint>] = &[
    viscous_friction::EFFECT,
    time_skew::EFFECT,
    coulomb_friction::EFFECT,
    backlash::EFFECT,
    hysteresis::EFFECT,
    encoder_ripple::EFFECT,
    sensor_offset::EFFECT,
    scales::STIFFNESS,
];

/// Whether a channel lies beyond a limit for more than this share of its rows, on either side.
fn balanced(values: &[f64], limit: f64, share: f64) -> bool {
    let beyond = |sign: f64| values.iter().filter(|v| sign * **v > limit).count() as f64;
    [1.0, -1.0]
        .iter()
        .all(|sign| beyond(*sign) > share * values.len() as f64)
}
