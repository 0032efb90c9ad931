//! The accelerometer reads too much or too little.

use super::contract::{Accelerance, Amount, Card, Cause, Sight};
use crate::effects::Family;
use crate::robot::Robot;
use nalgebra::Complex;

/// See the card.
pub struct AccelerometerGain;

const CARD: Card = Card {
    name: "accelerometer_gain",
    family: Family::Measurement,
    summary: "The accelerometer reads too much or too little along one axis, or along all of them (then the hammer may be at fault).",
    equation: "a′ = (1 + x)·a",
    source: "calibration of sensors: ISO 16063-21",
    shows: &[(
        Sight::Hammer,
        "the same factor at every frequency, resonances and damping where they were",
    )],
    amounts: &[Amount {
        name: "excess",
        unit: "1",
        meaning: "share by which the reading is too high",
        bounds: [-0.9, 4.0],
        starts: &[0.3],
    }],
};

impl Cause for AccelerometerGain {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn sites(&self, _robot: &Robot) -> Vec<String> {
        ["sensor", "sensor-x", "sensor-y", "sensor-z"]
            .map(String::from)
            .to_vec()
    }

    fn read_accelerance(
        &self,
        site: &str,
        amounts: &[f64],
        _s: Complex<f64>,
        frf: &mut Accelerance,
    ) {
        let own = ["sensor-x", "sensor-y", "sensor-z"];
        for (row, name) in frf.iter_mut().zip(own) {
            if site == "sensor" || site == name {
                row.iter_mut().for_each(|entry| *entry *= 1.0 + amounts[0]);
            }
        }
    }
}
