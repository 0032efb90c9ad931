//! Signs: a spring gives way along its load.

use super::{Course, Rule};
use crate::fit::suitability::{Said, Weight};

/// A spring gives way along its load, never against it.
pub const RULE: Rule = Rule {
    name: "reversed",
    remedy: "turn the sign of one column, or swap the columns back",
    look,
};

fn look(on: &Course) -> Said {
    match on.relation.is_real() && on.relation.slope < 0.0 {
        true => vec![(
            Weight::Fatal,
            "deflection runs against the load: a sign is wrong, or the columns are swapped".into(),
        )],
        false => Vec::new(),
    }
}
