//! The gate for joint motion.

mod clipped;
mod copied;
mod dead;
mod follows;
mod reversed;
mod scale;
mod unrelated;

use super::channel::{Channel, sum};
use super::{Doubt, Said};
use crate::ground::stats::difference;
use crate::measurement::joint_motion::{JointMotion, JointRecord};

/// What the rules look at: one joint.
pub struct Moving<'a> {
    /// The joint.
    pub joint: &'a JointRecord,
    /// Motor angle, link angle and torque, driven by time.
    pub channels: Vec<Channel>,
    /// Difference of the encoders per N·m on the link side, times the nominal stiffness: −1 for the nominal
    /// spring; none where no stiffness is known or the torque tells nothing of the difference.
    pub spring: Option<Spring>,
}

/// The spring that torque and difference of the encoders make.
pub struct Spring {
    /// Twist over torque, times the nominal stiffness.
    pub relative: f64,
    /// Share of the twist that torque describes beyond what a delay would, in proportion to speed.
    pub share: f64,
}

/// One rule of this kind.
pub type Rule = super::Rule<for<'a, 'b> fn(&'b Moving<'a>) -> Said>;

/// Every rule, in the order in which its findings are said.
pub const RULES: &[Rule] = &[
    dead::RULE,
    copied::RULE,
    clipped::RULE,
    follows::RULE,
    unrelated::RULE,
    reversed::RULE,
    scale::RULE,
];

/// Rows that are looked at, evenly spread.
const ROWS: usize = 4000;

/// What is odd about a file, the gravest first; `nominal` is the stiffness by joint that the simulation
/// has, N·m/rad.
pub fn doubts(file: &JointMotion, nominal: impl Fn(&JointRecord) -> Option<f64>) -> Vec<Doubt> {
    let of = |joint: &JointRecord| {
        let moving = Moving {
            channels: channels(joint),
            spring: nominal(joint).and_then(|k| spring(joint, k)),
            joint,
        };
        let mut own = super::doubts(RULES, |look| look(&moving));
        own.iter_mut()
            .for_each(|doubt| doubt.what = format!("{}: {}", joint.site(), doubt.what));
        own
    };
    let mut all: Vec<Doubt> = file.joints.iter().flat_map(of).collect();
    all.sort_by_key(|doubt| std::cmp::Reverse(doubt.weight));
    all
}

fn channels(joint: &JointRecord) -> Vec<Channel> {
    let named = [
        ("the motor angle", &joint.motor),
        ("the link angle", &joint.link),
        ("the motor torque", &joint.torque),
    ];
    let channel =
        |(name, values): (&str, &Vec<f64>)| Channel::new(name, values.clone(), joint.time.clone());
    named.into_iter().map(channel).collect()
}

impl JointRecord {
    /// Every so many rows of motor angle, link angle, torque and speed.
    fn thinned(&self) -> [Vec<f64>; 4] {
        let n = self.time.len();
        let by = n.div_ceil(ROWS).max(1);
        let reach = by.max(n / 400).max(1);
        let rows: Vec<usize> = (reach..n.saturating_sub(reach)).step_by(by).collect();
        let take = |v: &[f64]| rows.iter().map(|i| v[*i]).collect::<Vec<f64>>();
        let speed = rows.iter().map(|i| {
            let (a, b) = (i - reach, i + reach);
            (self.motor[b] - self.motor[a]) / (self.time[b] - self.time[a])
        });
        [
            take(&self.motor),
            take(&self.link),
            take(&self.torque),
            speed.collect(),
        ]
    }
}

fn spring(joint: &JointRecord, nominal: f64) -> Option<Spring> {
    joint.ratio?;
    let [motor, link, torque, speed] = joint.thinned();
    let twist: Vec<f64> = difference(&link, &motor);
    let without = sum(&twist, std::slice::from_ref(&speed))?;
    let with = sum(&twist, &[speed, torque])?;
    Some(Spring {
        relative: with.of[1] * nominal,
        share: with.share - without.share,
    })
}
