//! Floor 6: parameters from measurements, with what the measurements say about their uncertainty.

pub mod frf_identifiability;
pub mod frf_match;
pub mod frf_measured;
pub mod frf_model;
pub mod frf_tuning;
