//! Floor 5: one file per kind of experiment.

pub mod hammer_checks;
pub mod hammer_frf;
pub mod hammer_functions;
pub mod hammer_modes;
pub mod hammer_screen;
pub mod hammer_variance;
