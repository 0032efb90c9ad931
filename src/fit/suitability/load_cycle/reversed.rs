//! Signs: a spring gives way along its load.

use super::{Course, Rule};
use crate::fit::suitability::{Said, Weight, said_if};

/// A spring gives way along its load, never against it.
pub const RULE: Rule = Rule {
    name: "reversed",
    remedy: "turn the sign of one column, or swap the columns back",
    look,
};

fn look(on: &Course) -> Said {
    said_if(
        on.relation.is_real() && on.relation.slope < 0.0,
        Weight::Fatal,
        "deflection runs against the load: a sign is wrong, or the columns are swapped",
    )
}
