//! Signs and order of the axes: a weight turns with the sensor, it is not mirrored.

use super::{Rule, Turned};
use crate::fit::suitability::{Said, Weight, said_if};
use crate::ground::spatial::{cross, dot, norm};

/// The forces of a weight are a turned vector; a wrong sign or two swapped axes mirror it.
pub const RULE: Rule = Rule {
    name: "reversed",
    remedy: "turn the sign of that channel (load on the sensor), or correct the order of the axes",
    look,
};

/// Share of the volume of a turned frame beyond which a mirrored one is certain.
const MIRRORED: f64 = -0.3;

fn look(on: &Turned) -> Said {
    let (Some(x), Some(y), Some(z)) = (on.row(0), on.row(1), on.row(2)) else {
        return Vec::new();
    };
    let weights = [x, y, z].map(norm).iter().product::<f64>();
    let volume = dot(x, cross(y, z)) / weights;
    said_if(
        volume < MIRRORED,
        Weight::Fatal,
        "the forces are the mirror image of a weight: one sign or all three are wrong, or two axes are swapped",
    )
}
