//! Load cycles of one axis.
//!
//! The way of a load cycle: screen (noise, saturated span) → candidates (every effect's family of
//! curves) → search (sets of causes by evidence) → refine (shapes free) → compare (posterior,
//! ambiguity) → adequacy (is anything left?) → gain (cycles that were not fitted) → verdict.

pub mod adequacy;
pub mod ambiguity;
mod beyond;
mod case;
mod comparison;
mod conclusion;
pub mod diagnosis;
pub mod imposed;
pub mod lattice;
pub mod look_alikes;
mod naming;
mod naming_scales;
pub mod next;
pub mod present;
pub mod refine;
pub mod scales;
pub mod search;
pub mod structure;
pub mod tints;
pub mod unseen;

pub use diagnosis::{Diagnosis, Settings, diagnose};
pub use present::Present;
