//! Motion of joints with an encoder on either side of the gear.
//!
//! The difference of the encoders is torsion under the torque transmitted, and whatever the
//! instruments add. The way of a joint: channels (averaged, smoothed) → columns (what each cause would
//! add) → ripple (periodic in an angle) → noise (its colour) → search (sets of causes by evidence) →
//! unseen (gain on pieces of time held out) → stiffness (is it fixed at all?) → verdict.

mod case;
mod channels;
mod columns;
mod delay;
mod description;
mod diagnosis;
mod evidence;
mod joint;
mod named;
mod next;
mod noise;
mod parameters;
mod ripple;
mod stiffness;
mod unseen;

pub use channels::Channels;
pub use diagnosis::{MotionDiagnosis, diagnose};
pub use joint::JointFinding;
