//! Floor 2, the heart: one physical or instrumental effect is one file.
//!
//! Add the file, one `mod` line and one line in [`EFFECTS`]: fit, simulate, diagnose, synthesize and
//! explain all have it. Nothing else in the program knows an effect by its name.

pub mod composite;
pub mod contract;
pub mod scene;
mod shapes;

mod asymmetry;
mod backlash;
mod bouc_wen;
mod clearance_slider;
mod cosine_error;
mod coulomb_friction;
mod creep;
mod cubic_stiffness;
mod dry_slider;
mod hertz_contact;
mod hysteresis;
mod lever_arm;
mod loosening;
mod offset_gap;
mod quantization;
mod sensor_offset;
mod slip;
mod soft_zone;
mod spring;
mod stiffness;
mod thermal_drift;
mod time_skew;

pub use composite::Composite;
pub use contract::{Card, Effect, Family, Law, Parameter, Scale};
pub use scene::Scene;

/// The linear spring, which every load cycle has.
pub const SPRING: &dyn Effect = &spring::Spring;

/// Every effect: physics first, then the measurement chain from joint to file.
pub const EFFECTS: &[&dyn Effect] = &[
    SPRING,
    &backlash::Backlash,
    OFFSET_GAP,
    &soft_zone::SoftZone,
    &cubic_stiffness::CubicStiffness,
    &hertz_contact::HertzContact,
    &asymmetry::Asymmetry,
    &hysteresis::Hysteresis,
    &bouc_wen::BoucWen,
    &coulomb_friction::CoulombFriction,
    &creep::Creep,
    &loosening::Loosening,
    &stiffness::Stiffness,
    &slip::Slip,
    &time_skew::TimeSkew,
    &lever_arm::LeverArm,
    &cosine_error::CosineError,
    &thermal_drift::ThermalDrift,
    &sensor_offset::SensorOffset,
    &quantization::Quantization,
    DRY_SLIDER,
    CLEARANCE_SLIDER,
];

/// A gap that lies at some load.
pub const OFFSET_GAP: &dyn Effect = &offset_gap::OffsetGap;

/// The law of a test under imposed displacement: force over displacement, ports swapped.
pub const CLEARANCE_SLIDER: &dyn Effect = &clearance_slider::ClearanceSlider;

/// The same without a clearance.
pub const DRY_SLIDER: &dyn Effect = &dry_slider::DrySlider;

/// The effects of `library` that change the curve of a pressed joint.
pub fn shapes(library: &[&'static dyn Effect]) -> Vec<&'static dyn Effect> {
    library
        .iter()
        .copied()
        .filter(|e| e.role() == contract::Role::Shape)
        .collect()
}

/// The effect with this name.
pub fn named(name: &str) -> Option<&'static dyn Effect> {
    EFFECTS
        .iter()
        .copied()
        .find(|effect| effect.card().name == name)
}
