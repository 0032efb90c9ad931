//! Floor 5: one file per kind of experiment: what a model says it should have shown, and the charts.

mod around;
pub mod cubes;
pub mod drive_law;
pub mod finite_turns;
pub mod hammer_alike;
pub mod hammer_checks;
pub mod hammer_force;
pub mod hammer_frf;
pub mod hammer_functions;
pub mod hammer_given;
pub mod hammer_modes;
pub mod hammer_screen;
pub mod hammer_variance;
mod hammer_window;
pub mod load_cycle;
pub mod milling_force;
pub mod resonance;
pub mod robot_picture;
pub mod schedule;
pub mod stiffness_map;
pub mod survey;
pub mod workspace;
