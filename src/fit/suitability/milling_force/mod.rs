//! The gate for records of a dynamometer.

mod clock;
mod reversed;
mod scale;
mod unrelated;

use super::channel::{self, Channel};
use super::{Doubt, Said};
use crate::ground::spatial::V3;
use crate::measurement::milling_force::{CutFacts, CutSide, MillingForce, Record};
use std::f64::consts::{PI, TAU};

/// What the rules look at: the channels of all cuts, one after the other.
pub struct Cutting<'a> {
    /// The file.
    pub file: &'a MillingForce,
    /// Its three channels, driven by time.
    pub channels: Vec<Channel>,
}

/// One rule of this kind.
pub type Rule = super::Rule<for<'a, 'b> fn(&'b Cutting<'a>) -> Said>;

/// Every rule, in the order in which its findings are said.
pub const RULES: &[Rule] = &[
    channel::dead_rule(|on| channel::dead(&on.channels)),
    clock::RULE,
    channel::wild_rule(|on| channel::wild(&on.channels)),
    channel::clipped_rule(|on| channel::clipped(&on.channels)),
    unrelated::RULE,
    reversed::RULE,
    scale::RULE,
];

/// What is odd about a file, the gravest first.
pub fn doubts(file: &MillingForce) -> Vec<Doubt> {
    let time: Vec<f64> = file
        .records
        .iter()
        .flat_map(|r| r.time.iter().copied())
        .collect();
    let channel = |k: usize| {
        let values = file
            .records
            .iter()
            .flat_map(|r| r.force.iter().map(move |f| f[k]));
        Channel::new(["fx", "fy", "fz"][k], values.collect(), time.clone())
    };
    let cutting = Cutting {
        file,
        channels: (0..3).map(channel).collect(),
    };
    super::doubts(RULES, |look| look(&cutting))
}

impl Cutting<'_> {
    /// The cuts with their facts.
    fn cuts(&self) -> impl Iterator<Item = (&CutFacts, &Record)> {
        self.file.facts.cuts.iter().zip(&self.file.records)
    }

    /// Mean force on the tool in the cutting plane per N/mm² of tangential coefficient, as an ordinary law
    /// makes it, mm².
    fn expected(&self, cut: &CutFacts) -> [f64; 2] {
        let teeth = self.file.facts.teeth as f64;
        let radius = 0.5 * self.file.facts.diameter_m;
        let feed = cut.feed_m_s / (cut.spindle_rad_s / TAU * teeth);
        let across = (1.0 - cut.width_m / radius).clamp(-1.0, 1.0).acos();
        let (from, to) = match cut.side {
            CutSide::Slot => (0.0, PI),
            CutSide::Up => (0.0, across),
            CutSide::Down => (PI - across, PI),
        };
        let mut mean = [0.0; 2];
        for i in 0..STEPS {
            let phi = from + (i as f64 + 0.5) / STEPS as f64 * (to - from);
            let (s, c) = phi.sin_cos();
            let part = feed * s * cut.depth_m * teeth / TAU * (to - from) / STEPS as f64;
            mean[0] += part * (-c - RADIAL * s) * 1e6;
            mean[1] += part * (s - RADIAL * c) * 1e6;
        }
        mean
    }
}

/// Steps of the mean over the cut.
const STEPS: usize = 60;
/// Radial over tangential force of an ordinary cut.
const RADIAL: f64 = 0.4;

/// Mean force of a record, N.
fn mean(record: &Record) -> V3 {
    let n = record.force.len().max(1) as f64;
    std::array::from_fn(|k| record.force.iter().map(|f| f[k]).sum::<f64>() / n)
}
