//! The load history an effect answers to, with the scales that make its parameters comparable.

use crate::ground::stats::largest;

/// A load history and its natural scales. SI: s, N·m (or N), rad (or m).
#[derive(Debug, Clone)]
pub struct Scene {
    /// Time of each row, s, ascending.
    pub time: Vec<f64>,
    /// Load of each row, N·m or N.
    pub load: Vec<f64>,
    /// Largest absolute load.
    pub load_scale: f64,
    /// Elastic deflection at the largest load.
    pub deflection_scale: f64,
    /// Typical duration of one cycle, s.
    pub period: f64,
    /// Whole duration, s.
    pub duration: f64,
}

impl Scene {
    /// A scene over a load history; `stiffness` (any good guess) sets the deflection scale.
    pub fn new(time: Vec<f64>, load: Vec<f64>, stiffness: f64, cycles: usize) -> Self {
        let load_scale = largest(&load);
        let span = time.last().unwrap_or(&0.0) - time.first().unwrap_or(&0.0);
        let duration = if span > 0.0 { span } else { 1.0 };
        let load_scale = if load_scale > 0.0 { load_scale } else { 1.0 };
        Self {
            deflection_scale: (load_scale / stiffness).abs(),
            period: duration / cycles.max(1) as f64,
            duration,
            load_scale,
            time,
            load,
        }
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.load.len()
    }
}
