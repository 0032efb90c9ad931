//! Blind workspace and hammer tests with a known truth, for judging the diagnosis of whole robots.
//!
//! Written independently of `src`: its own kinematics and dynamics (products of 4x4 matrices,
//! numeric differentiation, kinetic energy summed over bodies), its own formulas for every effect, its
//! own integrator. Everything is a deterministic function of the seed.
#![allow(dead_code, unused_imports)]

mod case;
mod damping_case;
mod dynamics;
mod family;
mod hammer;
mod hammer_case;
mod hammer_effects;
mod hammer_strength;
mod instrument;
pub mod judge;
mod law;
mod noise;
mod poses;
mod propagator;
mod robot;
mod robot_text;
pub mod score;
mod score_checks;
mod structure;
pub mod suite;
mod workspace;
mod workspace_case;
mod workspace_effects;
mod workspace_strength;

pub use case::{Case, Truth};
pub use damping_case::{Mode, damping_case, miscalibrated_case, uncertain_case};
pub use dynamics::Dynamics;
pub use hammer_case::hammer_case;
pub use hammer_effects::{EFFECTS as HAMMER_EFFECTS, OUTSIDE as HAMMER_OUTSIDE};
pub use robot_text::robot_text;
pub use structure::OBLIQUE;
pub use workspace_case::workspace_case;
pub use workspace_effects::{EFFECTS as WORKSPACE_EFFECTS, OUTSIDE as WORKSPACE_OUTSIDE};
