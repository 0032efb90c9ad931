//! The force reads wrong by a factor.

use super::contract::{Amount, Card, Cause, Sight, StepSeen};
use crate::effects::Family;
use crate::ground::spatial::V3;

/// See the card.
pub struct ForceGain;

const CARD: Card = Card {
    name: "force_gain",
    family: Family::Measurement,
    summary: "The force sensor reads too much or too little, so that every displacement per newton is off by one factor.",
    equation: "d = (1 + g)·C·F",
    source: "calibration against dead weights: Ewins 2000",
    shows: &[(
        Sight::Workspace,
        "all stiffnesses off by the same factor, in every component",
    )],
    amounts: &[Amount {
        name: "gain_error",
        unit: "1",
        meaning: "displacement per newton read, over the true one, less one",
        bounds: [-0.9, 5.0],
        starts: &[0.25, -0.2],
    }],
};

impl Cause for ForceGain {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn read_step(&self, _site: &str, amounts: &[f64], _compliance: &[V3; 3], step: &mut StepSeen) {
        step.displacement = step.displacement.map(|d| d * (1.0 + amounts[0]));
    }
}
