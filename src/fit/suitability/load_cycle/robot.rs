//! The robot that the file names.

use super::{Course, Rule};
use crate::fit::suitability::{Said, Weight};
use crate::robot::load::load;

/// A stiffness goes into the robot that the file names.
pub const RULE: Rule = Rule {
    name: "robot",
    remedy: "correct `robot`, or put the robot file beside the measurement",
    look,
};

fn look(on: &Course) -> Said {
    let Some(name) = &on.file.facts.robot else {
        return Vec::new();
    };
    match load(name, Some(&on.file.path)) {
        Ok(_) => Vec::new(),
        Err(_) => vec![(
            Weight::Note,
            format!("the robot `{name}` is not known here"),
        )],
    }
}
