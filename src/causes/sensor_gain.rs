//! A displacement sensor reads wrong by a factor.

use super::contract::{Amount, Card, Cause, Sight, StepSeen};
use crate::effects::Family;
use crate::ground::spatial::V3;
use crate::measurement::workspace_test::DIRECTIONS;
use crate::robot::Robot;

/// See the card.
pub struct SensorGain;

const CARD: Card = Card {
    name: "sensor_gain",
    family: Family::Measurement,
    summary: "A displacement sensor reads too much or too little by a factor.",
    equation: "dₖ = (1 + g)·(C·F)ₖ for one component k, or for all",
    source: "calibration against gauge blocks: GUM 2008, section F.2",
    shows: &[(
        Sight::Workspace,
        "one component of every displacement off by the same factor, whatever the force",
    )],
    amounts: &[Amount {
        name: "gain_error",
        unit: "1",
        meaning: "displacement read over the true one, less one",
        bounds: [-0.9, 5.0],
        starts: &[0.25, -0.2],
    }],
};

impl Cause for SensorGain {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn sites(&self, _robot: &Robot) -> Vec<String> {
        let one = DIRECTIONS.iter().map(|k| format!("sensor-{k}"));
        one.chain(["sensor".into()]).collect()
    }

    fn read_step(&self, site: &str, amounts: &[f64], _compliance: &[V3; 3], step: &mut StepSeen) {
        for (k, name) in DIRECTIONS.iter().enumerate() {
            let own = site.strip_prefix("sensor-");
            if own.is_none_or(|own| own == *name) {
                step.displacement[k] *= 1.0 + amounts[0];
            }
        }
    }
}
