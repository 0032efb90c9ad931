//! Floor 6: what measurements say about unknowns, whatever was measured. One descent
//! ([`least_squares`]) and one linear-Gaussian update with its evidence ([`gaussian`]); the small
//! change of statistics lies on the ground ([`crate::ground::stats`]).

pub mod gaussian;
pub mod least_squares;
