//! Floor 1: what a laboratory wrote down. Reads tables with front matter into SI columns, then the
//! experiment kinds of `measurements/README.md`, refusing with file, line and remedy.

pub mod cycles;
pub mod front;
pub mod hammer;
pub mod hammer_known;
pub mod hammer_uff;
pub mod joint_motion;
pub mod leading;
pub mod load_cycle;
pub mod table;
pub mod uff;
pub mod workspace;
pub mod workspace_test;
