//! What is taken off every reading of the sensor before it counts as a force of the process.

use super::fitted::Fitted;
use super::remainder::{Remainder, terms};
use super::statics::{N, reading};

/// Physical model and remainder.
#[derive(Debug, Clone, PartialEq)]
pub struct Model {
    /// Parameters in the order of [`super::statics::PARAMETERS`], SI.
    pub p: [f64; N],
    /// Coefficients of the terms of [`super::remainder::TERMS`], six channels.
    pub polynomial: [[f64; 6]; 10],
}

impl Model {
    /// Of a fit and its remainder.
    pub fn new(fitted: &Fitted, remainder: &Remainder) -> Self {
        Self {
            p: fitted.p,
            polynomial: remainder.coefficients,
        }
    }

    /// What the sensor reads at an orientation without touching anything: N and N·m, sensor frame.
    pub fn unloaded(&self, q: [f64; 4]) -> [f64; 6] {
        let (physical, terms) = (reading(&self.p, q), terms(q));
        std::array::from_fn(|c| {
            physical[c]
                + (0..10)
                    .map(|t| terms[t] * self.polynomial[t][c])
                    .sum::<f64>()
        })
    }

    /// The load of the process in a reading: the reading less [`Model::unloaded`].
    pub fn corrected(&self, q: [f64; 4], load: [f64; 6]) -> [f64; 6] {
        let unloaded = self.unloaded(q);
        std::array::from_fn(|c| load[c] - unloaded[c])
    }
}
