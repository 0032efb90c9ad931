//! The robot that the file names.

use super::{Rule, Turned};
use crate::fit::suitability::{Said, Weight};
use crate::robot::load::load;

/// A file that names a robot is meant to belong to it.
pub const RULE: Rule = Rule {
    name: "robot",
    remedy: "correct `robot`, or put the robot file beside the measurement",
    look,
};

fn look(on: &Turned) -> Said {
    let Some(name) = &on.test.facts.robot else {
        return Vec::new();
    };
    match load(name, Some(&on.test.path)) {
        Ok(_) => Vec::new(),
        Err(_) => vec![(
            Weight::Note,
            format!("the robot `{name}` is not known here"),
        )],
    }
}
