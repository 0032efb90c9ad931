//! Floor 6: from measurements to parameters with their uncertainty.

pub mod axis_tests;
pub mod bootstrap;
pub mod candidates;
pub mod compliance;
pub mod convex;
pub mod force_steps;
pub mod frf_identifiability;
pub mod frf_match;
pub mod frf_measured;
pub mod frf_model;
pub mod frf_tuning;
pub mod identified_robot;
pub mod inspection;
pub mod least_squares;
pub mod normal;
pub mod observation;
pub mod parameter;
pub mod screen;
pub mod second;
pub mod separability;
pub mod solution;
pub mod starts;
pub mod stiffness;
pub mod store;
pub mod validation;
pub mod weighing;
