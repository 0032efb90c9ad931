//! The robot of a milled part: what another one would leave on the part.

use super::Case;
use super::hold::holds;
use super::tried::left;
use crate::findings::engine::Blamed;
use crate::findings::physics::{self, OnRobot};
use crate::ground::spatial::{V3, sub};
use crate::ground::stats::difference;
use crate::process::setup::{Setup, Support};
use crate::robot::Robot;
use std::sync::PoisonError;

/// Causes of the whole robot that a part shows.
const SHOWN: [&str; 4] = [
    "drive_stiffness",
    "tilt_stiffness",
    "missing_tilt",
    "tool_compliance",
];

/// Whether a cause sits in the robot.
pub(super) fn is_own(blamed: &Blamed) -> bool {
    blamed.shape.first().is_some_and(|form| *form >= 0.0)
}

/// Puts a cause into the robot; false for those that do not sit in it.
pub(super) fn alter(case: &Case, blamed: &Blamed, setup: &mut Setup) -> bool {
    let own = is_own(blamed);
    if own {
        physics::alter(case, blamed, &mut setup.robot);
    }
    own
}

impl Case {
    /// What another robot leaves on the part more, its swing as well; none where that cannot be milled.
    pub(super) fn coupled(&self, robot: &Robot) -> Option<Vec<f64>> {
        let known = |of: &Vec<(Robot, Option<Vec<f64>>)>| {
            let mut known = of.iter();
            known.find(|(other, _)| other == robot).map(|k| k.1.clone())
        };
        let milled = || self.milled.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = known(&milled()) {
            return known;
        }
        let told = self.coupled_anew(robot);
        milled().push((robot.clone(), told.clone()));
        told
    }

    fn coupled_anew(&self, robot: &Robot) -> Option<Vec<f64>> {
        let setup = Setup {
            robot: robot.clone(),
            ..self.trial.clone()
        };
        let all = left(&setup, &self.stations, Support::Coupled).ok()?;
        Some(difference(&self.seen(&all), self.base(Support::Coupled)?))
    }
}

impl OnRobot for Case {
    fn robot(&self) -> &Robot {
        &self.setup.robot
    }

    fn change(&self, robot: &Robot) -> Vec<f64> {
        if self.swings() {
            return self.coupled(robot).unwrap_or_default();
        }
        let Ok(other) = holds(&self.setup, robot, &self.stations) else {
            return Vec::new();
        };
        let pairs = other.iter().zip(&self.holds).zip(&self.stations);
        let moved: Vec<V3> = pairs
            .map(|((a, b), s)| sub(a.under(s.force), b.under(s.force)))
            .collect();
        self.answered(&moved)
    }

    fn is_straight(&self) -> bool {
        !self.swings()
    }

    fn may_hold(&self, column: &[f64]) -> bool {
        self.holds_some_of(column)
    }

    fn noise(&self) -> f64 {
        self.spread.iter().copied().fold(f64::INFINITY, f64::min)
    }

    fn shows(&self, cause: &str) -> bool {
        SHOWN.contains(&cause)
    }
}
