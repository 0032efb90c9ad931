//! Surveys of many points: modes with their shape at every point, beside those of a simulated robot.

pub mod assignment;
pub mod modes;
pub mod picture;
pub mod simulated;
