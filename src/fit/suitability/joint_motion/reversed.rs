//! Signs: the link lags behind the torque that drives it.

use super::{Moving, Rule};
use crate::fit::suitability::{Said, Weight};

/// A gear gives way along its torque, never against it.
pub const RULE: Rule = Rule {
    name: "reversed",
    remedy: "turn the sign of the motor torque, or of both angles",
    look,
};

/// Share of the twist that torque must describe, to be sure of its sign.
const SHARE: f64 = 0.5;

fn look(on: &Moving) -> Said {
    match &on.spring {
        Some(spring) if spring.share > SHARE && spring.relative > 0.0 => vec![(
            Weight::Fatal,
            "the link runs ahead of the motor under load: the sign of the torque is wrong".into(),
        )],
        _ => Vec::new(),
    }
}
