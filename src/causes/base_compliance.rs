//! The foundation gives way.

use super::contract::{Amount, Blame, Card, Cause, Sight};
use super::places::{Said, add_axes, added, drive_compliance, said_added, said_axes};
use crate::effects::Family;
use crate::ground::spatial::V3;
use crate::robot::Robot;
use crate::robot::model::ElasticAxis;

/// See the card.
pub struct BaseCompliance;

const CARD: Card = Card {
    name: "base_compliance",
    family: Family::Physics,
    summary: "The foundation gives way, and the model holds it rigid.",
    equation: "rotations about x, y, z of the base frame through its origin, and shifts along them, compliance added",
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
        shift("along_x", "compliance of the foundation along x"),
        shift("along_y", "compliance of the foundation along y"),
        shift("along_z", "compliance of the foundation along z"),
    ],
};

/// A compliance against shifting, in 1e-7 m/N.
const fn shift(name: &'static str, meaning: &'static str) -> Amount {
    Amount::new(name, "1e-7 m/N", meaning, [0.0, 100.0], &[1.0])
}

/// A shift is a turn about an axis this far away, m: a robot file knows turns only, and over the
/// reach of a robot the difference is below a tenth of a percent.
const FAR: f64 = 5000.0;

impl Cause for BaseCompliance {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn sites(&self, _robot: &Robot) -> Vec<String> {
        vec!["base".to_string()]
    }

    fn heard(&self) -> usize {
        3
    }

    fn blame(&self) -> Blame {
        Blame::Structure
    }

    fn scale(&self, robot: &Robot, _site: &str) -> Vec<f64> {
        let turn = drive_compliance(robot, 1);
        vec![turn, turn, turn, turn, turn, turn]
    }

    fn forms(&self) -> Vec<Vec<usize>> {
        let turns = [vec![0], vec![1], vec![2], vec![0, 1], vec![0, 1, 2]];
        let all = (0..6).collect();
        turns.into_iter().chain([vec![3, 4, 5], all]).collect()
    }

    /// Foot bolts stretch: a foundation rocks or heaves rather than that it turns about the vertical.
    fn shares(&self) -> Vec<f64> {
        vec![1.0, 1.0, 0.3, 1.0, 1.0, 0.5, 1.0]
    }

    fn alter(&self, robot: &mut Robot, site: &str, amounts: &[f64]) {
        add_axes(robot, site, 0, [0.0; 3], amounts);
        for (k, amount) in amounts.iter().enumerate().skip(3).take(3) {
            let before = robot.elastic.len();
            let (axis, point) = far_axis(k - 3);
            let mut turns = [0.0; 3];
            turns[axis] = amount / (FAR * FAR);
            add_axes(robot, site, 0, point, &turns);
            robot.elastic[before..].iter_mut().for_each(|added| {
                *added = ElasticAxis {
                    name: format!("{site}-along-{}", ["x", "y", "z"][k - 3]),
                    ..added.clone()
                };
            });
        }
    }

    fn said(&self, _robot: &Robot, _site: &str, amounts: &[f64]) -> Said {
        let names = [
            "stiffness_along_x",
            "stiffness_along_y",
            "stiffness_along_z",
        ];
        let along = names.iter().zip(amounts.iter().skip(3));
        let along = along.flat_map(|(name, amount)| said_added(name, *amount));
        let along = along.map(|(name, value, _)| (name, value, "N/m"));
        said_axes(amounts).into_iter().chain(along).collect()
    }
}

/// Index of the axis about which to turn for a shift along `k`, and a point on it.
fn far_axis(k: usize) -> (usize, V3) {
    let mut point = [0.0; 3];
    point[(k + 2) % 3] = FAR;
    ((k + 1) % 3, point)
}
