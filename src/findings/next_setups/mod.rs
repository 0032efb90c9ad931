//! Which set-ups to measure next on the whole robot: poses, loads and places of the sensor, each by
//! the information that it is computed to bring about what is known and what is not.
//!
//! Linear and Gaussian: deflection is linear in the compliances, so how much a reading would tell
//! follows from the model before anything is measured (Lindley 1956; Chaloner and Verdinelli 1995).

mod belief;
mod candidates;
mod choose;
mod document;
mod sights;
mod skeleton;
mod unknowns;

pub use belief::Belief;
pub use candidates::candidates;
pub use choose::{Chosen, Tells};
pub use document::SetupDocument;
pub use sights::{FOOT_LEVER, Noise, Reach, Seat, Setting, Sights};
pub use skeleton::Skeleton;
pub use unknowns::Unknowns;

use crate::experiments::workspace::Response;
use crate::fit::axis_tests::AxisTest;
use crate::fit::force_steps::setups;
use crate::fit::weighing::Weighing;
use crate::measurement::rig::Rig;
use crate::measurement::workspace_test::WorkspaceTest;
use crate::robot::Robot;

/// A plan of measurements.
#[derive(Debug, Clone)]
pub struct Plan {
    /// The set-ups, the most telling first.
    pub chosen: Vec<Chosen>,
    /// What is known before them.
    pub before: Belief,
    /// What will be known after them, whatever they read.
    pub after: Belief,
    /// The scatter that was reckoned with.
    pub noise: Noise,
    /// Set-ups to choose from.
    pub compared: usize,
}

/// What is known of a robot before the next measurement.
#[derive(Debug, Clone)]
pub struct Desk {
    /// What is not known.
    pub unknowns: Unknowns,
    /// What is known of it.
    pub belief: Belief,
    /// How readings scatter.
    pub noise: Noise,
    points: Vec<Vec<f64>>,
    rig: Rig,
}

impl Desk {
    /// From the robot, its axis tests, and the points that were measured already.
    pub fn new(robot: &Robot, tests: &[AxisTest], points: Option<&WorkspaceTest>) -> Self {
        let spread = points.and_then(|test| test.facts.nominal_rel_std);
        let unknowns = Unknowns::of(robot, tests, spread);
        let mut belief = unknowns.belief();
        if let Some(test) = points {
            learn_points(&mut belief, &unknowns, test);
        }
        Self {
            noise: Noise::of(points),
            points: points.map_or_else(Vec::new, |test| test.facts.joint_angles.clone()),
            rig: Rig::default(),
            unknowns,
            belief,
        }
    }

    /// The same, for a laboratory that can build only this.
    #[must_use]
    pub fn within(mut self, rig: Rig) -> Self {
        self.rig = rig;
        self
    }

    /// The `count` set-ups that tell most, each chosen knowing those before it. `open`: pairs of
    /// places that a diagnosis could not tell apart; separating them counts more.
    pub fn plan(&self, count: usize, open: &[(String, String)]) -> Plan {
        let settings = candidates(&self.unknowns.robot, &self.points, &self.rig);
        let sights = Sights::of(&self.unknowns);
        let rows = sights.all(&settings, &self.noise, &self.belief.mean);
        let open = self.belief.pairs(open);
        let (chosen, after) = choose::choose(&self.belief, &settings, &rows, count, &open);
        Plan {
            chosen,
            before: self.belief.clone(),
            after,
            noise: self.noise,
            compared: settings.len(),
        }
    }
}

/// Takes in the force steps of a campaign.
fn learn_points(belief: &mut Belief, unknowns: &Unknowns, test: &WorkspaceTest) {
    let response = Response::of(&unknowns.robot, &test.facts.joint_angles);
    let repeatability = test.facts.setup_repeatability.unwrap_or(0.0);
    let mut weighing = Weighing::new(&setups(test), repeatability);
    weighing.about_model(&response, &unknowns.compliances());
    let design = weighing.design(&response, &unknowns.sites);
    belief.learn(&design, &weighing.measured());
}
