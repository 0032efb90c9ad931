//! Floor 6: what measurements say about unknowns, whatever was measured. One descent ([`descent`]) and one
//! linear-Gaussian update with its evidence ([`gaussian`]), and how far a model may be wrong ([`doubt`]); the small change of statistics lies on the
//! ground ([`crate::ground::stats`]).

pub mod descent;
pub mod doubt;
pub mod gaussian;
