//! The robot that the file names.

use super::{Rule, Turned};
use crate::fit::suitability::{Said, strange_robot};

/// A file that names a robot is meant to belong to it.
pub const RULE: Rule = Rule {
    name: "robot",
    remedy: "correct `robot`, or put the robot file beside the measurement",
    look,
};

fn look(on: &Turned) -> Said {
    strange_robot(on.test.facts.robot.as_ref(), &on.test.path)
}
