//! One encoder in both columns.

use super::{Moving, Rule};
use crate::fit::suitability::{Said, Weight, extent, said_if};
use crate::ground::stats::difference;

/// Two encoders never agree to the last digit: a gear twists, and both have noise.
pub const RULE: Rule = Rule {
    name: "copied",
    remedy: "check which channel of the controller each column was taken from",
    look,
};

/// Share of the motion within which both angles are one: the last digits of a subtraction.
const SAME: f64 = 1e-12;

fn look(on: &Moving) -> Said {
    let (motor, link) = (&on.joint.motor, &on.joint.link);
    let twist: Vec<f64> = difference(link, motor);
    let (motion, twist) = (extent(motor), extent(&twist));
    said_if(
        motion > 0.0 && twist <= SAME * motion,
        Weight::Fatal,
        "the link angle repeats the motor angle: one encoder in both columns",
    )
}
