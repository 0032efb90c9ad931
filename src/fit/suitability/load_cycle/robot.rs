//! The robot that the file names.

use super::{Course, Rule};
use crate::fit::suitability::{Said, strange_robot};

/// A stiffness goes into the robot that the file names.
pub const RULE: Rule = Rule {
    name: "robot",
    remedy: "correct `robot`, or put the robot file beside the measurement",
    look,
};

fn look(on: &Course) -> Said {
    strange_robot(on.file.facts.robot.as_ref(), &on.file.path)
}
