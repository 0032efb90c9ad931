//! A coarse converter.

use super::{Course, Rule};
use crate::fit::suitability::{Said, Weight, said_if};

/// Readings that mostly repeat the one before hide noise and small effects.
pub const RULE: Rule = Rule {
    name: "coarse",
    remedy: "use a finer range of the converter",
    look,
};

fn look(on: &Course) -> Said {
    let file = on.file;
    let pairs = file.deflection.windows(2);
    let equal = pairs.clone().filter(|w| w[0] == w[1]).count();
    said_if(
        2 * equal > pairs.len(),
        Weight::Note,
        "most readings repeat one before: the converter is coarse",
    )
}
