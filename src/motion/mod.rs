//! Floor 4: how a robot moves and bends. Free functions over an immutable [`Chain`] and a reusable
//! [`Work`]; no allocation in the inner loop; every law over any scalar, so derivatives are free.

pub mod build;
pub mod chain;
pub mod circle;
pub mod dynamics;
pub mod forward;
pub mod frf;
pub mod hinge_law;
pub mod inverse;
pub mod kinematics;
pub mod linear;
pub mod modes;
pub mod numeric;
pub mod on_links;
pub mod posture;
pub mod receptance;
pub mod servo;
pub mod skeleton;
pub mod statics;
pub mod swing;
pub mod swing_state;
pub mod uncertain;
pub mod work;

pub use build::{elastic, rigid};
pub use chain::{Chain, Hinge};
pub use dynamics::{crba, gravity_torque, rnea};
pub use forward::aba;
pub use kinematics::{forward_kinematics, jacobian, tcp};
pub use linear::{Linear, linearise};
pub use work::Work;
