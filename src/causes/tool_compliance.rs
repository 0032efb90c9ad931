//! The tool or its mount bends.

use super::contract::{Blame, Card, Cause, Sight};
use super::places::{Said, add_axes_along, added, drive_compliance, said_axes};
use crate::effects::Family;
use crate::robot::Robot;

/// See the card.
pub struct ToolCompliance;

const CARD: Card = Card {
    name: "tool_compliance",
    family: Family::Physics,
    summary: "The tool, its holder or the spindle gives way, and the model holds it rigid.",
    equation: "rotations about the axes of the tool frame through the flange, compliance added",
    source: "virtual axes as in source 002, Table 1",
    shows: &[(
        Sight::Workspace,
        "the same error in the frame of the tool at every point",
    )],
    amounts: &[
        added("about_x", "compliance about x of the tool"),
        added("about_y", "compliance about y of the tool"),
        added("about_z", "compliance about z of the tool"),
        added("across", "compliance about x and y of the tool alike"),
    ],
};

impl Cause for ToolCompliance {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn sites(&self, robot: &Robot) -> Vec<String> {
        let lever = [0, 1, 2].map(|k| robot.tool.tcp[k] - robot.tool.flange[k]);
        let reaches = lever.iter().any(|x| x.abs() > 1e-6);
        reaches.then(|| "tool".to_string()).into_iter().collect()
    }

    fn blame(&self) -> Blame {
        Blame::Structure
    }

    /// A tool is short: it takes more radians to be seen than an arm.
    fn scale(&self, robot: &Robot, _site: &str) -> Vec<f64> {
        vec![5.0 * drive_compliance(robot, robot.dof()); 4]
    }

    fn forms(&self) -> Vec<Vec<usize>> {
        let pairs = [vec![0, 1], vec![0, 2], vec![1, 2]];
        let one = (0..3).map(|k| vec![k]);
        one.chain(pairs).chain([vec![0, 1, 2], vec![3]]).collect()
    }

    fn alter(&self, robot: &mut Robot, site: &str, amounts: &[f64]) {
        let (last, flange) = (robot.dof(), robot.tool.flange);
        let frame = robot.tool.rotation;
        let own = total(amounts);
        add_axes_along(robot, site, (last, flange), &frame, &own);
    }

    fn said(&self, _robot: &Robot, _site: &str, amounts: &[f64]) -> Said {
        said_axes(&total(amounts))
    }
}

/// About x, y and z.
fn total(amounts: &[f64]) -> [f64; 3] {
    let across = amounts[3];
    [amounts[0] + across, amounts[1] + across, amounts[2]]
}
