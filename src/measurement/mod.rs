//! Floor 1: what a laboratory wrote down. Reads tables with front matter into SI columns, then the
//! experiment kinds of `measurements/README.md`, refusing with file, line and remedy.

pub mod cubes;
pub mod cycles;
mod facts;
pub mod force_sensor;
pub mod foreign;
pub mod frf_uff;
pub mod front;
pub mod hammer;
pub mod hammer_known;
pub mod hammer_uff;
pub mod job;
pub mod joint_motion;
pub mod keys;
pub mod known_keys;
pub mod leading;
pub mod load_cycle;
pub mod milled_part;
pub mod milling_force;
pub mod modal;
pub mod pitch_table;
pub mod recorded_joints;
pub mod rig;
pub mod screw;
pub mod stl;
pub mod survey;
pub mod table;
pub mod test;
pub mod toolpath;
pub mod uff;
pub mod workspace;
pub mod workspace_test;
