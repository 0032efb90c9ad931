//! The model has a rigid bearing where the robot tilts.

use super::contract::{Blame, Card, Cause, Sight};
use super::places::{Said, added, added_spring, drive_compliance, said_added};
use crate::effects::Family;
use crate::robot::Robot;

/// See the card.
pub struct MissingTilt;

const CARD: Card = Card {
    name: "missing_tilt",
    family: Family::Physics,
    summary: "The bearing of an axis tilts, and the model holds it rigid.",
    equation: "1/k about both axes across the drive axis, instead of 0",
    source: "virtual axes as in source 000",
    shows: &[
        (
            Sight::Workspace,
            "the robot is softer than simulated across the plane of that drive; cross-components appear",
        ),
        (
            Sight::Hammer,
            "a mode or a share of one across the plane of that drive that the simulation lacks",
        ),
    ],
    amounts: &[added("compliance", "compliance of the bearing")],
};

impl Cause for MissingTilt {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn sites(&self, robot: &Robot) -> Vec<String> {
        let rigid = robot.joints.iter().filter(|joint| joint.tilt.is_none());
        rigid.map(|joint| joint.tilt_site()).collect()
    }

    fn blame(&self) -> Blame {
        Blame::Structure
    }

    fn scale(&self, robot: &Robot, site: &str) -> Vec<f64> {
        let own = robot.joints.iter().position(|j| j.tilt_site() == site);
        vec![drive_compliance(robot, own.map_or(0, |i| i + 1))]
    }

    fn alter(&self, robot: &mut Robot, site: &str, amounts: &[f64]) {
        let own = robot
            .joints
            .iter_mut()
            .find(|joint| joint.tilt_site() == site);
        if let Some(joint) = own {
            joint.tilt = added_spring(amounts[0]);
        }
    }

    fn said(&self, _robot: &Robot, _site: &str, amounts: &[f64]) -> Said {
        said_added("stiffness", amounts[0])
    }
}
