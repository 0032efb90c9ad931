//! Floor 7: what can be wrong with the simulation of the whole robot, or with what is measured on it.
//!
//! One cause is one file: add it, one `mod` line and one line in [`CAUSES`], and every experiment that
//! would show it seeks it, `ident effects` explains it, and the extended robot carries it. Nothing else
//! in the program knows a cause by its name. What no contract has a name for stands in [`OUTSIDE`].

pub mod contract;
pub mod places;
pub mod turns;

mod accelerometer_gain;
mod accelerometer_misalignment;
mod added_mass;
mod backlash;
mod base_compliance;
mod double_hit;
mod drive_stiffness;
mod exponential_window;
mod force_gain;
mod hung_body;
mod joint_damping;
mod link_compliance;
mod load_misalignment;
mod missing_tilt;
mod outlier_point;
mod sensor_gain;
mod tilt_stiffness;
mod time_skew;
mod tool_compliance;

pub use contract::{Amount, Blame, Card, Cause, Sight};
pub use hung_body::HUNG;

/// Every cause: physics first, then the instruments.
pub const CAUSES: &[&dyn Cause] = &[
    &drive_stiffness::DriveStiffness,
    &tilt_stiffness::TiltStiffness,
    &missing_tilt::MissingTilt,
    &base_compliance::BaseCompliance,
    &link_compliance::LinkCompliance,
    &tool_compliance::ToolCompliance,
    &added_mass::AddedMass,
    &joint_damping::JointDamping,
    &backlash::Backlash,
    &force_gain::ForceGain,
    &sensor_gain::SensorGain,
    &load_misalignment::LoadMisalignment,
    &outlier_point::OutlierPoint,
    &accelerometer_gain::AccelerometerGain,
    &accelerometer_misalignment::AccelerometerMisalignment,
    &time_skew::TimeSkew,
    &exponential_window::ExponentialWindow,
    &double_hit::DoubleHit,
];

/// What no contract has a name for, and what would be named in its place if nobody sought it.
pub const OUTSIDE: &[&dyn Cause] = &[&hung_body::HungBody];

/// The causes that one experiment would show.
pub fn seen_by(sight: Sight) -> impl Iterator<Item = &'static dyn Cause> {
    let shows = move |cause: &&&'static dyn Cause| {
        cause
            .card()
            .shows
            .iter()
            .any(|(where_, _)| *where_ == sight)
    };
    CAUSES.iter().filter(shows).copied()
}

/// The cause of this name.
pub fn named(name: &str) -> Option<&'static dyn Cause> {
    CAUSES
        .iter()
        .copied()
        .find(|cause| cause.card().name == name)
}
