//! `ident`: from measurements on disk to the identified milling robot.
#![warn(missing_docs)]

pub mod cli;
pub mod experiments;
pub mod fit;
pub mod ground;
pub mod measurement;
pub mod signal;
