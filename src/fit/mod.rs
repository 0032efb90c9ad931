//! Floor 6: from measurements to parameters with their uncertainty.

pub mod bootstrap;
pub mod candidates;
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
