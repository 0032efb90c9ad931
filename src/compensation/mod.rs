//! Floor 7: the programmed path moved so that the soft robot cuts the part that was drawn; what will be
//! left, and the proof that the corrected path stays within its limits.
//!
//! Corrections are normal to the feed where the tool is: along it they would change the time, not the part (source 002,
//! eqs. 10 and 11, with |v|² where the print has |v|).

pub mod answering;
pub mod calm;
pub mod corrected;
pub mod correction;
pub mod drawn;
pub mod draws;
pub mod executed;
pub mod limits;
pub mod method;
mod mirror;
mod near;
pub mod online;
mod points;
pub mod proof;
pub mod remaining;
pub mod shifted;
pub mod text;
mod trials;

pub use correction::Correction;
pub use method::{Method, Search, Task, search};
