//! The bearing of one axis is softer or stiffer than the model says.

use super::contract::{Card, Cause, Sight};
use super::places::{Said, excess, soften, softened};
use crate::effects::Family;
use crate::robot::Robot;

/// See the card.
pub struct TiltStiffness;

const CARD: Card = Card {
    name: "tilt_stiffness",
    family: Family::Physics,
    summary: "The bearing of an axis tilts more or less than the model says.",
    equation: "1/k = (1 + x)/k₀ about both axes across the drive axis",
    source: "Abele et al. 2008, C = Σ J Jᵀ/k; virtual axes as in source 000",
    shows: &[
        (
            Sight::Workspace,
            "error across the plane of that drive, growing with the square of the distance to its bearing",
        ),
        (
            Sight::Hammer,
            "modes across the plane of that drive lie at other frequencies",
        ),
    ],
    amounts: &[excess(
        "excess of the compliance of the bearing over that of the model",
    )],
};

impl Cause for TiltStiffness {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn sites(&self, robot: &Robot) -> Vec<String> {
        let elastic = robot.joints.iter().filter(|joint| joint.tilt.is_some());
        elastic.map(|joint| joint.tilt_site()).collect()
    }

    fn alter(&self, robot: &mut Robot, site: &str, amounts: &[f64]) {
        soften(robot, site, amounts[0]);
    }

    fn said(&self, robot: &Robot, site: &str, amounts: &[f64]) -> Said {
        softened(robot, site, amounts[0])
    }
}
