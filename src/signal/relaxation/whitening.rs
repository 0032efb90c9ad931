//! The filter that makes coloured readings independent.

/// A linear filter that makes coloured readings independent, of variance one.
#[derive(Debug, Clone, PartialEq)]
pub struct Whitening(Vec<Step>);

/// One reading of the filter.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Step {
    /// What every relaxation still has of itself.
    pub(super) kept: Vec<f64>,
    /// What it takes of the innovation.
    pub(super) gain: Vec<f64>,
    /// Inverse of the deviation of the innovation.
    pub(super) over: f64,
}

impl Whitening {
    /// Of the readings one after the other.
    pub(super) fn new(steps: Vec<Step>) -> Self {
        Self(steps)
    }

    /// Whitens readings.
    pub fn apply(&self, readings: impl Iterator<Item = f64>) -> Vec<f64> {
        let mut state = vec![0.0; self.0.first().map_or(0, |s| s.kept.len())];
        let one = |(step, reading): (&Step, f64)| {
            state.iter_mut().zip(&step.kept).for_each(|(s, k)| *s *= k);
            let new = reading - state.iter().sum::<f64>();
            state
                .iter_mut()
                .zip(&step.gain)
                .for_each(|(s, g)| *s += g * new);
            new * step.over
        };
        self.0.iter().zip(readings).map(one).collect()
    }
}
