//! Floor 4: the geometry of a tool path and its law of time; no robot. Everything is SI and in the
//! workpiece frame.
//!
//! A file's moves become [`element`]s; [`corner`]s are judged and blended, which makes one
//! [`Path`] of pieces by true arc length; orientations lie along it as quaternions; speeds are asked
//! for in steps and kept with limited jerk ([`profile`]); a [`Timeline`] says where the tool is when.
//!
//! Where a line meets an arc or a spline tangentially (within 1 mrad) nothing is blended: the
//! curvature jumps, as on a controller.

pub mod arc_length;
pub mod bezier;
pub mod build;
pub mod corner;
pub mod curve;
pub mod double_s;
pub mod element;
pub mod nearest;
pub mod nurbs;
pub mod orientation;
pub mod profile;
pub mod programs;
pub mod quaternion;
pub mod timeline;

pub use build::{Drawing, Path};
pub use curve::Curve;
pub use quaternion::Quaternion;
pub use timeline::Timeline;
