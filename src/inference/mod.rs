//! Floor 6: what measurements say about unknowns, whatever was measured: one linear-Gaussian
//! update with its evidence ([`gaussian`]). The one descent lies on the ground, since spectra use it too
//! ([`crate::ground::descent`]), and so does the small change of statistics ([`crate::ground::stats`]).

pub mod gaussian;
