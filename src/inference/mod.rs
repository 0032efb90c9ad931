//! Floor 6: what measurements say about unknowns, whatever was measured. One descent ([`descent`]) and one
//! linear-Gaussian update with its evidence ([`gaussian`]); the small change of statistics lies on the
//! ground ([`crate::ground::stats`]).

pub mod descent;
pub mod gaussian;
