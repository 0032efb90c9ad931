//! A force-torque sensor that carries a tool: weight, centre of mass, offsets, turn of the sensor and tilt
//! of the base, jointly (source 002, section 2.6, whose equations 12 to 16 hold misprints: statics is
//! written anew here).

mod descents;
pub mod fitted;
pub mod model;
pub mod next;
pub mod poses;
pub mod remainder;
mod sparse;
pub mod statics;
pub mod store;

use super::parameter::Identified;
use crate::ground::problem::Outcome;
use crate::measurement::force_sensor::SensorTest;
use fitted::Fitted;
use model::Model;
use poses::{Pose, poses};
use remainder::Remainder;

/// What was found.
#[derive(Debug, Clone)]
pub struct Account {
    /// One mean reading per orientation.
    pub poses: Vec<Pose>,
    /// The physical model with its covariance.
    pub fitted: Fitted,
    /// Its parameters as reported.
    pub parameters: Vec<Identified>,
    /// What is left over the orientation.
    pub remainder: Remainder,
    /// Both together.
    pub model: Model,
    /// Orientations worth measuring next, best first.
    pub next: Vec<next::Proposal>,
}

/// Identifies one sensor from all its `tests`.
///
/// # Errors
/// Fewer than two orientations.
pub fn identify(tests: &[SensorTest]) -> Outcome<Account> {
    let poses = poses(tests)?;
    let fitted = Fitted::of(&poses, poses::stated_noise(tests));
    let remainder = Remainder::of(&poses, &fitted);
    Ok(Account {
        parameters: fitted.parameters(),
        model: Model::new(&fitted, &remainder),
        next: next::proposals(&fitted, &poses),
        fitted,
        remainder,
        poses,
    })
}
