//! What is wrong with a robot, its measuring cubes, its frame or its load: cubes less the simulation.

mod about;
mod experiment;
mod floor;
mod force_gain;
mod frame_motion;
mod load_misalignment;
mod loose_cube;
mod noise;
mod patterns;
mod rows;
mod softer;

use super::physics::{self, OnRobot};
use super::table::Effect;
use crate::causes::Cause;
use crate::causes::places::number_in;
use crate::experiments::cubes::Setup;
use crate::ground::problem::Outcome;
use crate::ground::stats::difference;
use crate::measurement::cubes::CubeTest;
use crate::robot::Robot;
use about::About;
pub use rows::Row;

/// Effects of instruments and of elastic axes that the robot has; those of [`crate::causes`] come beside.
pub const EFFECTS: &[Effect<Case>] = &[
    softer::BASE,
    softer::LINK,
    softer::TOOL,
    loose_cube::EFFECT,
    frame_motion::EFFECT,
    force_gain::EFFECT,
    load_misalignment::EFFECT,
];

/// Cubes with the robot they sit on.
pub struct Case {
    /// The file.
    pub test: CubeTest,
    /// The robot as it is simulated.
    pub robot: Robot,
    /// The simulation.
    pub setup: Setup,
    /// Its rows, one for each number that was measured.
    pub rows: Vec<Row>,
    /// What was found, where it is stated about it; nothing at first.
    pub(super) about: About,
    /// Sites of the springs that the readings show.
    springs: Vec<String>,
    /// What the simulation says with cubes that sit fast, row by row, m.
    pub(super) fixed: Vec<f64>,
    /// What the simulation says, row by row, m.
    pub simulated: Vec<f64>,
    /// Measured less simulated, m.
    pub missed: Vec<f64>,
    /// Noise of a row, m.
    pub noise: f64,
    /// Readings that it is worth.
    pub worth: f64,
    /// Length by which rotations are multiplied, so that their noise is that of displacements, m.
    pub arm: f64,
}

/// Noise where none is stated: m and rad (source 002's laser sensors).
const NOISE: [f64; 2] = [2e-6, 1e-5];

/// How often a link bends where its robot file does not say so, against where it does: a choice,
/// small enough that a stated axis which is softer is told alone (`Judgement::ambiguous`), as nothing tells the two apart.
const BENDS_ELSEWHERE: f64 = 0.01;

/// Readings that a stated noise is worth.
const WORTH: f64 = 60.0;

impl Case {
    /// Of a file and its robot.
    ///
    /// # Errors
    /// The file does not fit the robot.
    pub fn new(test: CubeTest, robot: Robot) -> Outcome<Self> {
        let setup = Setup::new(&test, &robot)?;
        let look = |noise: [f64; 2]| {
            let arm = noise[0] / noise[1];
            let rows = rows::rows(&test, arm);
            let simulated = rows::model(&setup, &test, &rows, arm, |load| load);
            let each = rows.iter().zip(&simulated);
            let missed: Vec<f64> = each.map(|(row, s)| row.measured - s).collect();
            (arm, rows, simulated, missed)
        };
        let (arm, rows, _, missed) = look(NOISE);
        let told = noise::told(&test, &rows, &missed, arm);
        let own = |k: usize| {
            test.facts.noise[k]
                .or(told[k].map(|t| t.0))
                .unwrap_or(NOISE[k])
        };
        let noise = [own(0), own(1)];
        let shown = |k: usize| rows.iter().any(|row| row.component / 3 == k);
        let worth = |k: usize| match (shown(k), test.facts.noise[k]) {
            (false, _) | (_, Some(_)) => WORTH,
            _ => told[k].map_or(0.0, |t| t.1.min(WORTH)),
        };
        let worth = worth(0).min(worth(1));
        let (arm, rows, simulated, missed) = look(noise);
        let mut case = Self {
            about: About::default(),
            springs: Vec::new(),
            fixed: simulated.clone(),
            noise: noise[0],
            worth,
            missed,
            simulated,
            rows,
            setup,
            arm,
            robot,
            test,
        };
        let springs = physics::shown_springs(&case).into_iter();
        case.springs = springs.map(|(site, _)| site).collect();
        Ok(case)
    }

    /// Numbers of the tests, in the order of the file.
    pub fn tests(&self) -> Vec<i64> {
        let mut found: Vec<i64> = Vec::new();
        for row in &self.rows {
            if !found.contains(&row.test) {
                found.push(row.test);
            }
        }
        found
    }
}

impl OnRobot for Case {
    fn robot(&self) -> &Robot {
        &self.robot
    }

    fn change(&self, robot: &Robot) -> Vec<f64> {
        let fixed = self.fixed(robot, self.about.gain(), self.about.turn());
        if fixed.is_empty() {
            return Vec::new();
        }
        let there = self.loosened(&fixed);
        difference(&there, &self.simulated)
    }

    /// A link that the robot file bends at axes of its own is blamed through these first.
    fn readiness(&self, cause: &'static dyn Cause, site: &str) -> f64 {
        let link = number_in(site, "link");
        let is_bent = self.robot.elastic.iter().any(|a| Some(a.after) == link);
        cause.readiness(&self.robot, site) * if is_bent { BENDS_ELSEWHERE } else { 1.0 }
    }

    fn with_cause(&self, cause: &'static dyn Cause, site: &str, amounts: &[f64]) -> Robot {
        self.altered(None, Some((cause.card().name, site, amounts.to_vec())))
    }

    fn with_softer(&self, site: &str, excess: f64) -> Robot {
        self.altered(Some((site, excess)), None)
    }

    fn noise(&self) -> f64 {
        self.noise
    }

    fn shows(&self, _: &str) -> bool {
        true
    }
}
