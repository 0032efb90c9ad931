//! Floor 1: windows, spectra, frequency response functions, hits and modes, on plain slices in SI.
//!
//! Conventions: `e^{+jωt}`, `H1 = Sfx/Sff` with `Sfx = E[conj(F)·X]`, so a driving-point
//! accelerance has a positive imaginary part at resonance. An exponential window is applied to
//! force *and* response from the first sample on; then the estimate is `H(jω + σ)`, exactly, and
//! the model is evaluated there instead of correcting the data.

pub mod clipping;
pub mod coherence;
pub mod decay;
pub mod double_hit;
pub mod fault;
pub mod frf;
pub mod jackknife;
pub mod judge;
pub mod lscf;
pub mod modal_fit;
pub mod modal_model;
pub mod modes;
pub mod off_axis;
pub mod pulse;
pub mod spectrum;
pub mod stabilisation;
pub mod trigger;
pub mod window;
