//! Floor 6: what measurements say about unknowns, whatever was measured. One descent
//! ([`least_squares`]), one linear-Gaussian update with its evidence ([`gaussian`]), and the small
//! change of statistics ([`stats`]).

pub mod gaussian;
pub mod least_squares;
pub mod stats;
