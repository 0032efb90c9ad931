//! The response must depend on the load beyond chance.

use super::{Course, Rule};
use crate::fit::suitability::{Said, Weight, extent};

/// Noise, a walk or an oscillation of its own is no response to the load.
pub const RULE: Rule = Rule {
    name: "unrelated",
    remedy: "check that this sensor was recorded with this load, on one clock",
    look,
};

fn look(on: &Course) -> Said {
    let file = on.file;
    let still = extent(&file.load) <= 0.0 || extent(&file.deflection) <= 0.0;
    if still || on.imposed || on.is_part() {
        return Vec::new();
    }
    match &on.relation {
        found if found.is_real() => Vec::new(),
        found => vec![(
            Weight::Fatal,
            format!(
                "the deflection does not depend on the load beyond chance (its {} ramps disagree: p = {:.2}; \
                 the load describes {:.0} % of it)",
                found.ramps,
                found.p_value.min(1.0),
                100.0 * found.share.max(0.0)
            ),
        )],
    }
}
