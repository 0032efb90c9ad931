//! The tool or its mount bends.

use super::contract::{Blame, Card, Cause, Sight};
use super::places::{Said, add_axes_along, added, drive_compliance, said_added};
use super::turns::{SIX, TURNS, said_matrix, shared, sizes};
use crate::effects::Family;
use crate::ground::spatial::{M3, V3, dot, normals, scale, sub};
use crate::robot::Robot;

/// See the card.
pub struct ToolCompliance;

const CARD: Card = Card {
    name: "tool_compliance",
    family: Family::Physics,
    summary: "The tool, its holder or the spindle gives way, and the model holds it rigid.",
    equation: "rotations about axes of the tool frame through the flange, compliance added: a symmetric matrix",
    source: "virtual axes as in source 002, Table 1",
    shows: &[(
        Sight::Workspace,
        "the same error in the frame of the tool at every point",
    )],
    amounts: &[
        added("about_x", "compliance about x of the tool"),
        added("about_y", "compliance about y of the tool"),
        added("about_z", "compliance about z of the tool"),
        shared("about_yz", "compliance that y and z of the tool share"),
        shared("about_zx", "compliance that z and x of the tool share"),
        shared("about_xy", "compliance that x and y of the tool share"),
        added(
            "across",
            "compliance about both axes across the line from the flange to the tool centre point alike",
        ),
    ],
};

impl Cause for ToolCompliance {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn sites(&self, robot: &Robot) -> Vec<String> {
        let reaches = dot(lever(robot), lever(robot)) > 0.5;
        reaches.then(|| "tool".to_string()).into_iter().collect()
    }

    fn blame(&self) -> Blame {
        Blame::Structure
    }

    /// A tool is short: it takes more radians to be seen than an arm.
    fn scale(&self, robot: &Robot, _site: &str) -> Vec<f64> {
        let own = 5.0 * drive_compliance(robot, robot.dof());
        [&sizes(own)[..], &[own]].concat()
    }

    fn forms(&self) -> Vec<Vec<usize>> {
        let pairs = [vec![0, 1], vec![0, 2], vec![1, 2]];
        let one = (0..3).map(|k| vec![k]);
        let all = [vec![0, 1, 2], vec![SIX], (0..SIX).collect()];
        one.chain(pairs).chain(all).collect()
    }

    fn matrices(&self) -> Vec<usize> {
        vec![0]
    }

    fn alter(&self, robot: &mut Robot, site: &str, amounts: &[f64]) {
        let at = (robot.dof(), robot.tool.flange);
        let frame = robot.tool.rotation;
        add_axes_along(robot, site, at, &frame, &amounts[..SIX]);
        let across = columns(normals(lever(robot)));
        let both = [amounts[SIX], amounts[SIX], 0.0];
        add_axes_along(robot, &format!("{site}-across"), at, &across, &both);
    }

    fn said(&self, _robot: &Robot, _site: &str, amounts: &[f64]) -> Said {
        let across = said_added("stiffness_across", amounts[SIX]);
        let turns = said_matrix(&amounts[..SIX], &TURNS);
        turns.into_iter().chain(across).collect()
    }
}

/// From the flange to the tool centre point, unit length.
fn lever(robot: &Robot) -> V3 {
    let lever = sub(robot.tool.tcp, robot.tool.flange);
    scale(1.0 / dot(lever, lever).sqrt().max(1e-9), lever)
}

/// Two vectors as the first columns of a matrix.
fn columns((a, b): (V3, V3)) -> M3 {
    [0, 1, 2].map(|k| [a[k], b[k], 0.0])
}
