//! Floor 6: from measurements to parameters with their uncertainty.

pub mod bootstrap;
pub mod least_squares;
pub mod observation;
pub mod parameter;
pub mod solution;
