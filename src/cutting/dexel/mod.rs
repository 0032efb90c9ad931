//! Stock as three sets of parallel rays (tri-dexel), in the workpiece frame: each ray keeps the pieces
//! of itself that lie in material, so memory grows with the surface, and no face is blind to all three
//! (source 004, 11.2.2; Benouamer and Michelucci 1997).

mod arc;
pub mod cells;
mod crossing;
mod depth;
pub mod engagement;
pub mod frame;
mod grid;
mod heading;
mod mesh;
mod part;
mod ray;
pub mod rings;
pub mod solid;
pub mod stock;
mod upright;

pub use engagement::Engagement;
pub use rings::rings;
pub use solid::Solid;
pub use stock::Stock;
