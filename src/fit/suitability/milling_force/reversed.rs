//! Signs: the tool is pushed back by what it cuts.

use super::{Cutting, Rule, mean};
use crate::fit::suitability::{Said, Weight, extent, said_if};

/// A chip resists: the mean force on the tool points against its edges.
pub const RULE: Rule = Rule {
    name: "reversed",
    remedy: "correct `force_on` (workpiece or tool), the signs of the channels, or the side of the cut",
    look,
};

/// Cosine between mean and expected force below which the force drives the tool.
const AGAINST: f64 = -0.5;
/// Share of a channel's range that the mean must have to be a force, not an offset.
const STANDS_OUT: f64 = 0.1;

fn look(on: &Cutting) -> Said {
    let against = |expected: [f64; 2], force: [f64; 2], range: f64| {
        let size = |v: [f64; 2]| v[0].hypot(v[1]);
        let cosine =
            (expected[0] * force[0] + expected[1] * force[1]) / (size(expected) * size(force));
        cosine < AGAINST && size(force) > STANDS_OUT * range
    };
    let range = extent(&on.channels[0].values).max(extent(&on.channels[1].values));
    let every = on.cuts().all(|(cut, record)| {
        let [x, y, _] = mean(record);
        against(on.expected(cut), [x, y], range)
    });
    said_if(
        every,
        Weight::Fatal,
        "the mean force drives the tool in every cut: its sign is wrong",
    )
}
