//! `ident`: from measurements on disk to the identified milling robot.
#![warn(missing_docs)]

pub mod cli;
pub mod effects;
pub mod experiments;
pub mod findings;
pub mod fit;
pub mod ground;
pub mod laboratory;
pub mod measurement;
pub mod motion;
pub mod report;
pub mod robot;
pub mod sheet;
pub mod signal;
