//! Load cycles of one axis.
//!
//! The way of a load cycle: reduce (at most 1000 rows) → families of shapes (`families`) → noise and sets
//! of causes in turn (`statement`, `noise`, and the common engine) → the named laws fitted (`case`,
//! `refine`) → scales and lattice → what is left → verdict (`conclusion`).

mod beyond;
mod case;
mod conclusion;
pub mod diagnosis;
mod evidence;
pub mod families;
pub mod imposed;
mod intervals;
pub mod lattice;
pub mod look_alikes;
mod naming;
mod naming_scales;
pub mod next;
pub mod noise;
mod not_noise;
mod patterns;
pub mod present;
mod read_load;
pub mod refine;
mod repeats;
pub mod scales;
mod span;
mod statement;
pub mod structure;
pub mod unseen;

pub use diagnosis::{Diagnosis, Settings, diagnose};
pub use present::Present;
