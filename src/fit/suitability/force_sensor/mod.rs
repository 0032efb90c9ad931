//! The gate for readings of a force-torque sensor that touches nothing.

mod dead;
mod reversed;
mod robot;
mod scale;
mod unrelated;

use super::channel::{self, Channel, Sum, sum};
use super::{Doubt, Said};
use crate::ground::spatial::{V3, norm, of_quaternion, rotate_back, sub};
use crate::measurement::force_sensor::{CHANNELS, SensorTest};
use nalgebra::{Matrix3, Vector3};

/// What the rules look at: six channels over the direction of the weight.
pub struct Turned<'a> {
    /// The test.
    pub test: &'a SensorTest,
    /// Its channels, driven by a number that tells orientations apart.
    pub channels: Vec<Channel>,
    /// Whether the weight points into all directions of the sensor, one after the other: else a force may stay as it is.
    pub all_round: bool,
    /// Each channel over the direction of the weight in the sensor frame; none where orientations are too
    /// few to tell.
    pub sums: Vec<Option<Sum>>,
}

/// Least standard deviation of the direction of the weight, along the direction in which it changes least, from which on every
/// force must change: six degrees.
const ROUND: f64 = 0.1;

/// Whether directions differ in every direction.
fn is_all_round(down: &[V3]) -> bool {
    let count = down.len().max(1) as f64;
    let middle: V3 = std::array::from_fn(|k| down.iter().map(|d| d[k]).sum::<f64>() / count);
    let off = down.iter().map(|d| Vector3::from(sub(*d, middle)));
    let spread = off.fold(Matrix3::zeros(), |sum, d| sum + d * d.transpose() / count);
    spread.symmetric_eigenvalues().min() > ROUND * ROUND
}

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
    let all_round = is_all_round(&down);
    let over_weight = |c: &Channel| all_round.then(|| sum(&c.values, &along))?;
    let turned = Turned {
        test,
        all_round,
        sums: channels.iter().map(over_weight).collect(),
        channels,
    };
    super::doubts(RULES, |look| look(&turned))
}

impl Turned<'_> {
    /// Weight that each force channel alone shows, N.
    fn weights(&self) -> Option<V3> {
        let rows: Option<Vec<f64>> = (0..3).map(|c| Some(norm(self.row(c)?))).collect();
        V3::try_from(rows?).ok()
    }

    fn row(&self, c: usize) -> Option<V3> {
        V3::try_from(self.sums[c].as_ref()?.of.clone()).ok()
    }
}
