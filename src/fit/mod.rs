//! Floor 6: from measurements to parameters with their uncertainty.

pub mod bootstrap;
pub mod candidates;
pub mod damping;
pub mod damping_store;
pub mod frf_identifiability;
pub mod frf_match;
pub mod frf_measured;
pub mod frf_model;
pub mod frf_residuals;
pub mod frf_robot;
pub mod frf_tuning;
pub mod inspection;
pub mod least_squares;
pub mod normal;
pub mod observation;
pub mod parameter;
pub mod screen;
pub mod second;
pub mod solution;
pub mod starts;
pub mod stiffness;
pub mod store;
