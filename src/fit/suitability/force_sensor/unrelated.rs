//! The force must follow the orientation.

use super::{Rule, Turned};
use crate::fit::suitability::{Said, Weight};

/// A force that does not follow the direction of the weight is noise, or another channel.
pub const RULE: Rule = Rule {
    name: "unrelated",
    remedy: "check which channel was recorded in this column, and the order of the points",
    look,
};

/// Share of its squares that a force must have from the weight.
const SHARE: f64 = 0.5;

fn look(on: &Turned) -> Said {
    let own = on.channels.iter().zip(&on.sums).take(3);
    let lost = own.filter(|(_, sum)| sum.as_ref().is_some_and(|s| s.share < SHARE));
    lost.map(|(c, _)| {
        let what = format!("{} does not follow the orientation of the sensor", c.name);
        (Weight::Fatal, what)
    })
    .collect()
}
