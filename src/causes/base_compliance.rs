//! The foundation gives way.

use super::contract::{Card, Cause, Sight};
use super::places::{Said, add_axes, added, said_axes};
use crate::effects::Family;
use crate::robot::Robot;

/// See the card.
pub struct BaseCompliance;

const CARD: Card = Card {
    name: "base_compliance",
    family: Family::Physics,
    summary: "The foundation gives way, and the model holds it rigid.",
    equation: "rotations about x, y, z of the base frame through its origin, compliance added",
    source: "source 004; knowledge of foot bolts: Worden and Tomlinson 2001",
    shows: &[
        (
            Sight::Workspace,
            "error whose pattern is fixed in the base frame, not in the arm",
        ),
        (
            Sight::Hammer,
            "low modes in which the whole robot rocks; a sensor on the foot moves in phase",
        ),
    ],
    amounts: &[
        added("about_x", "compliance of the foundation about x"),
        added("about_y", "compliance of the foundation about y"),
        added("about_z", "compliance of the foundation about z"),
    ],
};

impl Cause for BaseCompliance {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn sites(&self, robot: &Robot) -> Vec<String> {
        let free = robot.elastic.iter().all(|axis| axis.after != 0);
        free.then(|| "base".to_string()).into_iter().collect()
    }

    fn alter(&self, robot: &mut Robot, site: &str, amounts: &[f64]) {
        add_axes(robot, site, 0, [0.0; 3], amounts);
    }

    fn said(&self, _robot: &Robot, _site: &str, amounts: &[f64]) -> Said {
        said_axes(amounts)
    }
}
