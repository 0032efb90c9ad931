//! Floor 5: one file per kind of experiment: what a model says it should have shown, and the charts.

pub mod load_cycle;
