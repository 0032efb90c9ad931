//! The gate for positions of a linear axis.

mod copied;
mod few;
mod follows;
mod order;

use super::channel::{self, Channel};
use super::{Doubt, Said};
use crate::measurement::screw::ScrewTest;

/// What the rules look at: the scale beside the targets.
pub struct Axis<'a> {
    /// The test.
    pub test: &'a ScrewTest,
    /// The scale, driven by the target.
    pub channels: Vec<Channel>,
}

/// One rule of this kind.
pub type Rule = super::Rule<for<'a, 'b> fn(&'b Axis<'a>) -> Said>;

/// Every rule, in the order in which its findings are said.
pub const RULES: &[Rule] = &[
    channel::dead_rule(|on| channel::dead(&on.channels)),
    channel::wild_rule(|on| channel::wild(&on.channels)),
    channel::clipped_rule(|on| channel::clipped(&on.channels)),
    follows::RULE,
    order::RULE,
    copied::RULE,
    few::RULE,
];

/// What is odd about a test, the gravest first.
pub fn doubts(test: &ScrewTest) -> Vec<Doubt> {
    let readings = &test.readings;
    let actual = readings.iter().map(|r| r.actual).collect();
    let target = readings.iter().map(|r| r.target).collect();
    let axis = Axis {
        channels: vec![Channel::new("actual", actual, target)],
        test,
    };
    super::doubts(RULES, |look| look(&axis))
}
