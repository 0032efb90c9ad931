//! Hammer tests of the whole robot.
//!
//! The way of a hammer test: FRFs of all good hits, seen through a short exponential window (broad
//! peaks, so that far starts arrive) and through a long one → what is uncertain although nothing is
//! wrong fits along, with its prior → sets of causes by evidence → what cannot be told apart → gain on
//! hits that were not fitted → is anything left, does the FRF depend on the force → verdict.

pub mod adequacy;
pub mod case;
mod chord;
pub mod data;
pub mod diagnosis;
pub mod discrepancy;
pub mod doubled;
mod doubt;
pub mod extended;
mod further;
mod hanging;
mod leaning;
pub mod linearity;
pub mod machine;
pub mod map;
mod name;
pub mod next;
pub mod nuisance;
pub mod point;
pub mod prediction;
pub mod search;
mod seat;
pub mod set;
pub mod strayed;
pub mod structure;
pub mod suspect;
pub mod unseen;

pub use diagnosis::{Diagnosis, diagnose};
