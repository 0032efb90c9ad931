//! The stated direction must be that in which the targets follow each other.

use super::{Axis, Rule};
use crate::fit::suitability::{Said, Weight, said_if};

/// With the directions swapped the backlash is corrected the wrong way.
pub const RULE: Rule = Rule {
    name: "direction",
    remedy: "correct the column `direction`: forward approaches towards larger targets",
    look,
};

/// Neighbouring readings of one run that must be there to tell.
const FEWEST: usize = 4;

fn look(on: &Axis) -> Said {
    let readings = &on.test.readings;
    let next = readings.windows(2).filter(|w| {
        w[0].run == w[1].run && w[0].forward == w[1].forward && w[0].target != w[1].target
    });
    let (mut with, mut against) = (0, 0);
    next.for_each(|w| match (w[1].target > w[0].target) == w[1].forward {
        true => with += 1,
        false => against += 1,
    });
    said_if(
        against >= FEWEST && against > 3 * with,
        Weight::Odd,
        format!(
            "in {against} of {} steps the targets run against the stated direction",
            with + against
        ),
    )
}
