//! Floor 7, the heart: what the simulation gets wrong, and why.
//!
//! The way of a load cycle through this floor:
//! screen (noise, saturated span) → candidates (every effect's family of curves) → search (sets of
//! causes by evidence) → refine (shapes free) → compare (posterior, ambiguity) → adequacy (is
//! anything left?) → gain (cycles that were not fitted) → verdict.

pub mod adequacy;
pub mod ambiguity;
pub mod diagnosis;
pub mod discrepancy;
pub mod gain;
pub mod imposed;
pub mod lattice;
pub mod look_alikes;
pub mod next;
pub mod refine;
pub mod scales;
pub mod search;
pub mod sentence;

pub use diagnosis::{Cause, Diagnosis, Group, Settings, Verdict, diagnose};
