//! The gate for force steps at points of the workspace.

mod clipped;
mod dead;
mod few;
mod reversed;
mod scale;
mod twice;
mod unchanging;
mod unrelated;
mod wild;

use super::{Doubt, Said};
use crate::experiments::workspace::Response;
use crate::fit::force_steps::{Setup, setups};
use crate::ground::spatial::M3;
use crate::measurement::workspace_test::{DIRECTIONS, WorkspaceTest};
use crate::robot::Robot;

/// What the rules look at: the test, its lines, and what the present simulation says of them.
pub struct Loaded {
    /// The test.
    pub test: WorkspaceTest,
    /// The lines of its set-ups.
    pub setups: Vec<Setup>,
    /// Displacement per force along x, y, z (m/N) by point, one row per direction of the force; none
    /// without a robot.
    pub simulated: Option<Vec<M3>>,
}

/// One rule of this kind.
pub type Rule = super::Rule<fn(&Loaded) -> Said>;

/// Every rule, in the order in which its findings are said.
pub const RULES: &[Rule] = &[
    unchanging::RULE,
    dead::RULE,
    wild::RULE,
    clipped::RULE,
    reversed::RULE,
    unrelated::RULE,
    scale::RULE,
    few::RULE,
    twice::RULE,
];

/// What is odd about a test, the gravest first; `robot` is the one that simulates it, if it is known.
pub fn doubts(test: &WorkspaceTest, robot: Option<&Robot>) -> Vec<Doubt> {
    let simulated = robot.map(|robot| simulated(robot, &test.facts.joint_angles));
    let loaded = Loaded {
        setups: setups(test),
        simulated,
        test: test.clone(),
    };
    super::doubts(RULES, |look| look(&loaded))
}

fn simulated(robot: &Robot, points: &[Vec<f64>]) -> Vec<M3> {
    let response = Response::of(robot, points);
    let compliances = response.compliances();
    let of = |point| std::array::from_fn(|d| response.slope(point, d, &compliances));
    (0..points.len()).map(of).collect()
}

/// `P3 y`.
fn name(setup: &Setup) -> String {
    format!("P{} {}", setup.point + 1, DIRECTIONS[setup.direction])
}

/// Names, at most six of them.
fn names<'a>(setups: impl Iterator<Item = &'a Setup>) -> String {
    let all: Vec<String> = setups.map(name).collect();
    match all.len() {
        0..=6 => all.join(", "),
        n => format!("{} and {} more", all[..5].join(", "), n - 5),
    }
}

/// Slope along the force and its standard error, m/N, where it was measured.
fn own(setup: &Setup) -> Option<(f64, f64)> {
    let line = setup.lines[setup.direction]?;
    Some((line.slope, line.stderr))
}
