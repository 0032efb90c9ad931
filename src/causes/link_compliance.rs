//! A link bends.

use super::contract::{Card, Cause, Sight};
use super::places::{Said, add_axes, added, said_axes};
use crate::effects::Family;
use crate::robot::Robot;

/// See the card.
pub struct LinkCompliance;

const CARD: Card = Card {
    name: "link_compliance",
    family: Family::Physics,
    summary: "A link bends or twists, and the model holds it rigid.",
    equation: "rotations about three axes in the middle of the link, compliance added",
    source: "virtual axes as in sources 000 and 002, Table 1",
    shows: &[
        (
            Sight::Workspace,
            "error that turns with that link and grows with the distance from its middle",
        ),
        (
            Sight::Hammer,
            "modes in which the parts before and behind the middle of the link move apart",
        ),
    ],
    amounts: &[
        added("about_x", "compliance about x, with every joint at zero"),
        added("about_y", "compliance about y, with every joint at zero"),
        added("about_z", "compliance about z, with every joint at zero"),
    ],
};

impl Cause for LinkCompliance {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn sites(&self, robot: &Robot) -> Vec<String> {
        (1..robot.dof()).map(|i| format!("link{i}")).collect()
    }

    fn alter(&self, robot: &mut Robot, site: &str, amounts: &[f64]) {
        let number: Option<usize> = site.strip_prefix("link").and_then(|n| n.parse().ok());
        let Some(i) = number.filter(|i| *i >= 1 && *i < robot.dof()) else {
            return;
        };
        let (from, to) = (robot.joints[i - 1].point, robot.joints[i].point);
        let middle = [0, 1, 2].map(|k| 0.5 * (from[k] + to[k]));
        add_axes(robot, site, i, middle, amounts);
    }

    fn said(&self, _robot: &Robot, _site: &str, amounts: &[f64]) -> Said {
        said_axes(amounts)
    }
}
