//! Signs: cubes move as the load pushes the structure.

use super::{Loaded, Rule};
use crate::fit::suitability::{Said, Weight};

/// A structure gives way along the load, never against it.
pub const RULE: Rule = Rule {
    name: "reversed",
    remedy: "turn the sign of that column or of the load (base frame, on the robot)",
    look,
};

/// Standard errors beyond which a component runs against the simulation.
const SURE: f64 = 6.0;
/// Cosine beyond which it runs against it as a whole.
const AGAINST: f64 = -0.5;

fn look(on: &Loaded) -> Said {
    let all = on.beside();
    let against = all
        .iter()
        .filter(|b| b.alike < AGAINST && b.ratio < -SURE * b.stderr);
    against
        .map(|b| {
            (
                Weight::Fatal,
                format!("{} runs against the load: its sign is wrong", b.name),
            )
        })
        .collect()
}
