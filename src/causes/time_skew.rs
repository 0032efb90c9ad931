//! Force and acceleration are not sampled together.

use super::contract::{Accelerance, Amount, Card, Cause, Sight};
use crate::effects::Family;
use nalgebra::Complex;

/// See the card.
pub struct TimeSkew;

const CARD: Card = Card {
    name: "time_skew",
    family: Family::Measurement,
    summary: "The acceleration is recorded later than the force (or earlier).",
    equation: "H′(s) = H(s)·e^(−sτ)",
    source: "shift theorem of the Laplace transform",
    shows: &[(
        Sight::Hammer,
        "a phase error that grows in a straight line with frequency; magnitudes stay",
    )],
    amounts: &[Amount {
        name: "delay",
        unit: "s",
        meaning: "time by which the acceleration comes too late",
        bounds: [-0.02, 0.02],
        starts: &[0.002],
    }],
};

impl Cause for TimeSkew {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn read_accelerance(
        &self,
        _site: &str,
        amounts: &[f64],
        s: Complex<f64>,
        frf: &mut Accelerance,
    ) {
        let turn = (-s * amounts[0]).exp();
        frf.iter_mut().flatten().for_each(|entry| *entry *= turn);
    }
}
