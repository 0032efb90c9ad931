//! The link must follow the motor.

use super::{Moving, Rule};
use crate::fit::suitability::channel::sum;
use crate::fit::suitability::magnitude::{explanation, times};
use crate::fit::suitability::{Said, Weight};

/// Both encoders see one joint, but for a twist of arc minutes.
pub const RULE: Rule = Rule {
    name: "encoders",
    remedy: "check unit and sign of both angles, the gear ratio that the motor angle is divided by, and the number of the joint",
    look,
};

/// Share of the link's squares that the motor describes.
const SHARE: f64 = 0.9;
/// Relative difference of two encoders that no gear has.
const GAIN: f64 = 0.05;

fn look(on: &Moving) -> Said {
    let [motor, link, ..] = on.joint.thinned();
    let Some(line) = sum(&link, &[motor]) else {
        return Vec::new();
    };
    let slope = line.of[0];
    let what = match () {
        () if line.share < SHARE => "the link angle does not follow the motor angle".into(),
        () if slope < 0.0 => "the link angle runs against the motor angle: a sign is wrong".into(),
        () if (slope - 1.0).abs() > GAIN => format!(
            "the link turns {} the motor angle{}",
            times(slope),
            why(slope)
        ),
        () => return Vec::new(),
    };
    vec![(Weight::Fatal, what)]
}

/// Degrees taken for radians or the other way about, or a power of ten.
fn why(slope: f64) -> String {
    let degrees = [1.0_f64.to_degrees(), 1.0_f64.to_radians()];
    match degrees.iter().any(|d| (slope / d - 1.0).abs() < 0.05) {
        true => "; degrees were taken for radians".into(),
        false => explanation(slope).map_or(String::new(), |why| format!("; {why}")),
    }
}
