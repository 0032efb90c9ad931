//! Floor 5: a robot on a path: which joint angles follow it, on which branch, with which turn about
//! the spindle, at which feed, and what of it the robot cannot do.

pub mod adapt;
pub mod cell;
pub mod exceeded;
pub mod follow;
pub mod plan;
pub mod program;
pub mod ride;
pub mod spin;
pub mod trajectory;
pub mod turn_search;

pub use cell::Cell;
pub use exceeded::Exceeded;
pub use plan::{Plan, Unreached, plan};
