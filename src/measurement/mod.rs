//! Floor 1: what laboratories deliver, as channels in SI.

pub mod columns;
pub mod hammer;
pub mod hammer_uff;
pub mod uff;
