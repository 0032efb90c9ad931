//! The robot of a milled part: what another one would leave on the part.

use super::Case;
use super::hold::holds;
use crate::findings::engine::Blamed;
use crate::findings::physics::{self, OnRobot};
use crate::ground::spatial::{V3, sub};
use crate::process::setup::Setup;
use crate::robot::Robot;

/// Causes of the whole robot that a part shows.
const SHOWN: [&str; 4] = [
    "drive_stiffness",
    "tilt_stiffness",
    "missing_tilt",
    "tool_compliance",
];

/// Puts a cause into the robot; false for those that do not sit in it.
pub(super) fn alter(case: &Case, blamed: &Blamed, setup: &mut Setup) -> bool {
    let own = blamed.shape.first().is_some_and(|form| *form >= 0.0);
    if own {
        physics::alter(case, blamed, &mut setup.robot);
    }
    own
}

impl OnRobot for Case {
    fn robot(&self) -> &Robot {
        &self.setup.robot
    }

    fn change(&self, robot: &Robot) -> Vec<f64> {
        let Ok(other) = holds(&self.setup, robot, &self.stations) else {
            return Vec::new();
        };
        let pairs = other.iter().zip(&self.holds).zip(&self.stations);
        let moved: Vec<V3> = pairs
            .map(|((a, b), s)| sub(a.under(s.force), b.under(s.force)))
            .collect();
        self.answered(&moved)
    }

    fn noise(&self) -> f64 {
        self.spread.iter().copied().fold(f64::INFINITY, f64::min)
    }

    fn shows(&self, cause: &str) -> bool {
        SHOWN.contains(&cause)
    }
}
