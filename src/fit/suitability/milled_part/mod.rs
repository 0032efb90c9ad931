//! The gate for probed parts.

mod clipped;
mod copied;
mod dead;
mod few;
mod scale;

use super::channel::{self, Channel};
use super::{Doubt, Said};
use crate::measurement::milled_part::PartTest;

/// What the rules look at: the probed components in the order of the file.
pub struct Probed<'a> {
    /// The test.
    pub test: &'a PartTest,
    /// `dx`, `dy` and `dz`, as far as they were probed.
    pub channels: Vec<Channel>,
}

/// One rule of this kind.
pub type Rule = super::Rule<for<'a, 'b> fn(&'b Probed<'a>) -> Said>;

/// Every rule, in the order in which its findings are said.
pub const RULES: &[Rule] = &[
    dead::RULE,
    channel::wild_rule(|on| channel::wild(&on.channels)),
    clipped::RULE,
    scale::RULE,
    few::RULE,
    copied::RULE,
];

/// What is odd about a test, the gravest first.
pub fn doubts(test: &PartTest) -> Vec<Doubt> {
    let order: Vec<f64> = (0..test.readings.len()).map(|i| i as f64).collect();
    let channel = |(k, name): (usize, &str)| {
        let values: Vec<f64> = test.readings.iter().map(|r| r.deviation[k]).collect();
        let probed = values.iter().any(|v| v.is_finite());
        probed.then(|| Channel::new(name, values, order.clone()))
    };
    let names = ["dx", "dy", "dz"].into_iter().enumerate();
    let probed = Probed {
        channels: names.filter_map(channel).collect(),
        test,
    };
    super::doubts(RULES, |look| look(&probed))
}
