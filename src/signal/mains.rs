//! The mains: what oscillates at its frequency came in by a cable.

/// Frequencies of the mains, Hz: most of the world; the Americas and parts of Asia.
pub const MAINS_HZ: [f64; 2] = [50.0, 60.0];
