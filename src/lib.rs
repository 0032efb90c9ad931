//! `ident`: from measurements on disk to the identified milling robot.
#![warn(missing_docs)]

pub mod cli;
pub mod ground;
pub mod motion;
pub mod robot;
