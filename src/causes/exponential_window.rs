//! The analyser applied an exponential window that the file does not declare.

use super::contract::{Amount, Card, Cause, Sight};
use super::places::Said;
use crate::effects::Family;
use crate::robot::Robot;

/// See the card.
pub struct ExponentialWindow;

const CARD: Card = Card {
    name: "exponential_window",
    family: Family::Measurement,
    summary: "The records carry an exponential window that the file does not declare.",
    equation: "H′(s) = H(s + σ), σ = 1/τ",
    source: "shift theorem of the Laplace transform; Ewins 2000",
    shows: &[(
        Sight::Hammer,
        "every mode seems damped by the same rate, the lowest the most in its damping ratio",
    )],
    amounts: &[Amount {
        name: "rate",
        unit: "1/s",
        meaning: "rate of the window, one over its time constant",
        bounds: [0.0, 100.0],
        starts: &[1.0, 4.0],
    }],
};

impl Cause for ExponentialWindow {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn undeclared_rate(&self, amounts: &[f64]) -> f64 {
        amounts[0]
    }

    fn said(&self, _robot: &Robot, _site: &str, amounts: &[f64]) -> Said {
        vec![("time_constant", 1.0 / amounts[0].max(1e-9), "s")]
    }
}
