//! The drive of one axis is softer or stiffer than the model says.

use super::contract::{Card, Cause, Sight};
use super::places::{Said, drives, excess, soften, softened};
use crate::effects::Family;
use crate::robot::Robot;

/// See the card.
pub struct DriveStiffness;

const CARD: Card = Card {
    name: "drive_stiffness",
    family: Family::Physics,
    summary: "The drive of an axis is softer or stiffer than the model says.",
    equation: "1/k = (1 + x)/k₀",
    source: "Abele et al. 2008, C = Σ J Jᵀ/k",
    shows: &[
        (
            Sight::Workspace,
            "error that grows with the square of the lever to that axis, in every component",
        ),
        (
            Sight::Hammer,
            "the modes in which that axis turns lie at other frequencies",
        ),
    ],
    amounts: &[excess(
        "excess of the compliance of the drive over that of the model",
    )],
};

impl Cause for DriveStiffness {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn sites(&self, robot: &Robot) -> Vec<String> {
        drives(robot)
    }

    fn alter(&self, robot: &mut Robot, site: &str, amounts: &[f64]) {
        soften(robot, site, amounts[0]);
    }

    fn said(&self, robot: &Robot, site: &str, amounts: &[f64]) -> Said {
        softened(robot, site, amounts[0])
    }
}
