//! Units: measured beside simulated movement.

use super::{Loaded, Rule};
use crate::fit::suitability::magnitude::{explanation, times};
use crate::fit::suitability::{Said, Weight};

/// Movement far from the simulated one at all cubes is a unit, not a joint.
pub const RULE: Rule = Rule {
    name: "scale",
    remedy: "check the units at the ends of the column names, the load, and the robot that the file names",
    look,
};

/// Ratio of measured to simulated movement that no robot shows in a whole component.
const FAR: f64 = 8.0;
/// Cosine from which a component follows the load.
const FOLLOWS: f64 = 0.4;

fn look(on: &Loaded) -> Said {
    let far = |ratio: f64| !(1.0 / FAR..=FAR).contains(&ratio);
    let all = on.beside();
    let odd = all.iter().filter(|b| b.alike > FOLLOWS && far(b.ratio));
    odd.map(|b| {
        let why = explanation(b.ratio).map_or(String::new(), |why| format!("; {why}"));
        let what = format!(
            "{} is {} what the simulation says{why}",
            b.name,
            times(b.ratio)
        );
        (Weight::Fatal, what)
    })
    .collect()
}
