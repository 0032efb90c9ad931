//! Cubes must follow the load.

use super::{Loaded, Rule};
use crate::fit::suitability::{Said, Weight};

/// Movement that does not follow the load is noise, or another channel.
pub const RULE: Rule = Rule {
    name: "unrelated",
    remedy: "check which cube and component was recorded in this column",
    look,
};

/// Cosine between measured and simulated below which a component does not follow, however soft the robot.
const ALIKE: f64 = 0.4;

fn look(on: &Loaded) -> Said {
    let stated = |name: &str| on.test.facts.noise[usize::from(name.starts_with('r'))];
    let all = on.beside();
    let lost = all.iter().filter(|b| {
        let seen = stated(b.name).is_none_or(|noise| b.measured > 3.0 * noise);
        b.alike.abs() < ALIKE && seen && b.measured > 0.1 * b.simulated
    });
    lost.map(|b| {
        (
            Weight::Fatal,
            format!("{} does not follow the load", b.name),
        )
    })
    .collect()
}
