//! Floor 1: what can be said about samples without knowing what they measure.

pub mod colour;
pub mod cosine;
pub mod outliers;
pub mod smooth;
