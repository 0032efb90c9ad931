//! Floor 3: what a robot is. Joints with drive and tilt, virtual elastic axes anywhere, a tool;
//! read from `ident`'s own TOML, from URDF, or built in; checked before anything is computed.

pub mod body;
pub mod builtin;
pub mod check;
pub mod dh;
pub mod file;
pub mod guess;
pub mod joint_effect;
pub mod load;
pub mod model;
pub mod spring;
pub mod urdf;
pub mod write;
mod xml;

pub use body::Body;
pub use joint_effect::JointEffect;
pub use load::load;
pub use model::{ElasticAxis, Joint, Robot, Tool};
pub use spring::Spring;
