//! `ident`: from measurements on disk to the identified milling robot, and to what its simulation
//! still gets wrong.
//!
//! The house, floor by floor; a module uses only floors below its own (`tests/floors.rs`):
//!
//! ```text
//! 10 cli          one file per verb
//!  9 report       text, HTML, SVG, JSON: ink for a sheet
//!  8 findings     what the simulation gets wrong, and why    laboratory  known truth, hidden effects
//!  7 fit          parameters, intervals, stored fits    causes    of the whole robot, ONE FILE EACH    process  robot and cut
//!  6 inference    one descent, one linear-Gaussian update with its evidence
//!  5 experiments  what a model says that a measurement should have shown    planning  a robot on a path
//!  4 motion       kinematics, dynamics, statics, modes, FRFs    path  geometry and time of tool paths
//!  3 robot        chain, springs, bodies, robot files
//!  2 effects      ONE FILE PER EFFECT    cutting  tools, force laws, the stock
//!  1 measurement  files and their facts    signal  spectra, noise    sheet  tables and charts as data
//!  0 ground       units, dual numbers, spatial algebra, files, problems with a remedy
//! ```
//!
//! From a file to its stiffness, and to the cause of what the simulation misses:
//!
//! ```
//! use ident::findings::{Settings, diagnose, sentence::sentence};
//! use ident::fit::stiffness::{DEFAULT_EFFECTS, Request, identify};
//! use ident::{effects::Composite, measurement::load_cycle::LoadCycle};
//!
//! let file = LoadCycle::read("measurements/kr210/axis6.csv".as_ref()).unwrap();
//! let model = Composite::named(DEFAULT_EFFECTS).unwrap();
//! let account = identify(&file, &Request { model, bootstrap: 0, seed: 1 });
//! assert!((account.parameters[0].value.unwrap() / 314_030.0 - 1.0).abs() < 0.003);
//!
//! let found = diagnose(&file, &Settings::default());
//! assert_eq!(found.causes[0].effect, "backlash");
//! println!("{}", sentence(&found));
//! ```
#![warn(missing_docs)]

pub mod causes;
pub mod cli;
pub mod compensation;
pub mod cutting;
pub mod effects;
pub mod experiments;
pub mod findings;
pub mod fit;
pub mod ground;
pub mod inference;
pub mod laboratory;
pub mod measurement;
pub mod motion;
pub mod path;
pub mod planning;
pub mod process;
pub mod report;
pub mod robot;
pub mod sheet;
pub mod signal;
