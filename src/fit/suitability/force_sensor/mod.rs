//! The gate for readings of a force-torque sensor that touches nothing.

mod dead;
mod reversed;
mod robot;
mod scale;
mod unrelated;

use super::channel::{self, Channel, Sum, sum};
use super::{Doubt, Said};
use crate::ground::spatial::{V3, norm, of_quaternion, rotate_back};
use crate::ground::stats::{mean, rms};
use crate::measurement::force_sensor::{CHANNELS, SensorTest};

/// What the rules look at: six channels over the direction of the weight.
pub struct Turned<'a> {
    /// The test.
    pub test: &'a SensorTest,
    /// Its channels, driven by a number that tells orientations apart.
    pub channels: Vec<Channel>,
    /// Whether the weight comes to point along and across each axis of the sensor: else that force may stay as it is.
    pub changes: [bool; 3],
    /// Each channel over the direction of the weight in the sensor frame; none where orientations are too
    /// few to tell, or change nothing of it.
    pub sums: Vec<Option<Sum>>,
}

/// Least standard deviation of a component of the direction of the weight from which on the force along that axis must change: six
/// degrees.
const CHANGES: f64 = 0.1;

/// One rule of this kind.
pub type Rule = super::Rule<for<'a, 'b> fn(&'b Turned<'a>) -> Said>;

/// Every rule, in the order in which its findings are said.
pub const RULES: &[Rule] = &[
    dead::RULE,
    channel::wild_rule(|on| channel::wild(&on.channels)),
    channel::clipped_rule(|on| channel::clipped(&on.channels)),
    unrelated::RULE,
    reversed::RULE,
    scale::RULE,
    robot::RULE,
];

/// What is odd about a test, the gravest first.
pub fn doubts(test: &SensorTest) -> Vec<Doubt> {
    let down: Vec<V3> = test
        .readings
        .iter()
        .map(|r| rotate_back(&of_quaternion(r.quaternion), [0.0, 0.0, -1.0]))
        .collect();
    let along: Vec<Vec<f64>> = (0..3)
        .map(|k| down.iter().map(|d| d[k]).collect())
        .collect();
    let apart = |d: &V3| d[0] + 1.3 * d[1] + 1.7 * d[2];
    let apart: Vec<f64> = down.iter().map(apart).collect();
    let channel = |(c, (name, _)): (usize, &(&str, &str))| {
        let values = test.readings.iter().map(|r| r.load[c]).collect();
        Channel::new(*name, values, apart.clone())
    };
    let channels: Vec<Channel> = CHANNELS.iter().enumerate().map(channel).collect();
    let changes = [0, 1, 2].map(|k| {
        let middle = mean(&along[k]);
        let off: Vec<f64> = along[k].iter().map(|x| x - middle).collect();
        rms(&off) > CHANGES
    });
    // a component that hardly changes is rounding, and tells nothing
    let told = along.iter().zip(changes);
    let told: Vec<Vec<f64>> = told
        .map(|(own, changes)| own.iter().map(|x| if changes { *x } else { 0.0 }).collect())
        .collect();
    let over_weight = |(c, channel): (usize, &Channel)| {
        let may = changes.get(c).copied().unwrap_or(changes.contains(&true));
        may.then(|| sum(&channel.values, &told))?
    };
    let turned = Turned {
        test,
        changes,
        sums: channels.iter().enumerate().map(over_weight).collect(),
        channels,
    };
    super::doubts(RULES, |look| look(&turned))
}

impl Turned<'_> {
    /// Weight that each force channel alone shows, N, as far as it must show one.
    fn weights(&self) -> Vec<(&Channel, f64)> {
        let own = self.channels.iter().take(3).enumerate();
        own.filter_map(|(c, channel)| Some((channel, norm(self.row(c)?))))
            .collect()
    }

    fn row(&self, c: usize) -> Option<V3> {
        V3::try_from(self.sums[c].as_ref()?.of.clone()).ok()
    }
}
