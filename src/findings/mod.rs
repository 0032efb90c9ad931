//! Floor 8, the heart: what the simulation gets wrong, and why. One folder per kind of measurement;
//! all of them answer in the same form.

pub mod answer;
pub mod belief;
mod bent;
pub mod campaign;
pub mod cubes;
mod document;
pub mod engine;
pub mod force_sensor;
pub mod gain;
pub mod hammer;
pub mod joint;
pub mod joint_motion;
pub mod kinds;
pub mod load_cycle;
pub mod milled_part;
pub mod milling_force;
pub mod next_setups;
mod physics;
pub mod screw;
pub mod sentence;
pub mod table;
pub mod workspace;

pub use answer::{Answer, Cause, Group, Verdict};
pub use load_cycle::{Diagnosis, Settings, diagnose};
