//! One encoder in both columns.

use super::{Moving, Rule};
use crate::fit::suitability::{Said, Weight};

/// The rule.
pub const RULE: Rule = Rule {
    name: "copied",
    about: "Two encoders never agree to the last digit: a gear twists, and both have noise.",
    remedy: "check which channel of the controller each column was taken from",
    look,
};

/// Share of the motion within which both angles are one.
const SAME: f64 = 1e-12;

fn look(on: &Moving) -> Said {
    let range = |of: &dyn Fn(usize) -> f64| {
        let each = (0..on.joint.time.len()).map(of);
        let ends = each.fold((f64::MAX, f64::MIN), |(l, h), v| (l.min(v), h.max(v)));
        ends.1 - ends.0
    };
    let motion = range(&|i| on.joint.motor[i]);
    let twist = range(&|i| on.joint.link[i] - on.joint.motor[i]);
    match motion > 0.0 && twist <= SAME * motion {
        true => vec![(
            Weight::Fatal,
            "the link angle repeats the motor angle: one encoder in both columns".into(),
        )],
        false => Vec::new(),
    }
}
