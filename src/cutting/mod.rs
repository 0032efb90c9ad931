//! Floor 2: the cut: tools, force laws, chips, wave forms of force, stability.
//!
//! Cut frame: x along the feed of the tool, z the spindle axis (into the spindle), y = z × x. The tooth
//! angle φ runs from +y towards +x. Forces are those on the tool. SI throughout.
//!
//! A force law is one file and one line in [`LAWS`].

mod carried;
mod chebyshev;
pub mod chip;
pub mod cutter;
pub mod dexel;
pub mod directional;
pub mod law;
pub mod mean;
pub mod stability;
mod stirred;
pub mod tool;
pub mod wave;

mod kienzle;
mod krylov;
mod linear_edge;

pub use law::{CuttingLaw, Material};
pub use tool::{Disc, Tool};

/// The law of Altintas: what `[material]` of a job means unless it says otherwise.
pub const LINEAR_EDGE: &dyn CuttingLaw = &linear_edge::LinearEdge;

/// Every force law.
pub const LAWS: &[&dyn CuttingLaw] = &[LINEAR_EDGE, &kienzle::Kienzle];
