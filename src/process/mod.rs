//! Floor 6: robot and cut together: the programmed way, a structure that gives way (or does not), and
//! the tool in its stock, step by step.
//!
//! A [`structure::Structure`] is one file: [`rigid`], [`springs`] (deflection = compliance × force) or
//! [`swinging`] (masses, dampers and springs in time); [`loose`] adds the gaps and contacts of joints to both. [`run`] leads any of them along a [`way::Way`].

mod book;
pub mod chatter;
pub mod course;
pub mod loose;
pub mod measured_tip;
mod not_cut;
pub mod oscillator;
pub mod planned;
pub mod pose;
mod rapid;
pub mod recorded;
pub mod rigid;
pub mod run;
pub mod setup;
pub mod springs;
pub mod structure;
pub mod swinging;
pub mod tip_modes;
pub mod uncertainty;
pub mod way;

pub use planned::Planned;
pub use run::{Cut, Outcome as Milled, Settings, mill};
pub use way::{Moment, Row, Way};
