//! Floor 1: what can be said about samples without knowing what they measure.

pub mod clipping;
pub mod coherence;
pub mod colour;
pub mod cosine;
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
pub mod outliers;
pub mod pulse;
pub mod smooth;
pub mod spectrum;
pub mod stabilisation;
pub mod trigger;
pub mod window;
