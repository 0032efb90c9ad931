//! The diagnosis of one joint: from its record to what is named and what is left.

use super::case::Case;
use super::channels::{Channels, rms};
use super::columns::{Atom, Kind};
use super::delay::{Delay, delay};
use super::description;
use super::named::{self, Named};
use super::stiffness::{Compliance, compliance};
use super::unseen::{amplitudes, residual};
use crate::findings::answer::Candidate;
use crate::measurement::joint_motion::JointRecord;
use statrs::distribution::{ChiSquared, ContinuousCDF};

/// Structure counts as left when a test is below this p-value and its share above the other.
const SIGNIFICANT: f64 = 1e-6;
const SHARE_LEFT: f64 = 0.1;

/// What is known of the present simulation of a joint.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Nominal {
    /// Stiffness, N·m/rad.
    pub stiffness: Option<f64>,
    /// Its relative standard deviation.
    pub rel_std: f64,
}

/// A diagnosed joint.
pub struct JointFinding {
    /// Its site.
    pub site: String,
    /// Its channels.
    pub data: Channels,
    /// Twist that the present simulation predicts, rad.
    pub simulated: Vec<f64>,
    /// Twist that the extended model predicts, rad.
    pub explained: Vec<f64>,
    /// Causes and groups.
    pub named: Named,
    /// The delay, if one is named or declared.
    pub delay: Option<Delay>,
    /// Delay that the file declares, s.
    pub declared: Option<f64>,
    /// The compliance, or why there is none.
    pub compliance: Result<Compliance, &'static str>,
    /// Sets that were compared.
    pub candidates: Vec<Candidate>,
    /// Noise of one reading, rad, and in words.
    pub noise_rms: f64,
    /// The noise in words.
    pub noise: String,
    /// Share of the discrepancy's variance that is left.
    pub share_left: f64,
    /// Probability that chance leaves so much.
    pub p_value: f64,
    /// Whether structure is left.
    pub is_left: bool,
    /// Where the discrepancy is largest.
    pub place: &'static str,
    /// What is left, in words.
    pub description: Option<String>,
}

impl JointFinding {
    /// What the named causes leave of the twist, rad.
    pub fn residual(&self) -> Vec<f64> {
        let pairs = self.data.twist.iter().zip(&self.explained);
        pairs.map(|(y, f)| y - f).collect()
    }

    /// What the present simulation misses, rad.
    pub fn missed(&self) -> Vec<f64> {
        let pairs = self.data.twist.iter().zip(&self.simulated);
        pairs.map(|(y, f)| y - f).collect()
    }
}

/// Diagnoses one joint.
pub fn diagnose_joint(record: &JointRecord, nominal: Nominal) -> JointFinding {
    let case = Case::new(record, nominal);
    let chosen = case.choose();
    case.conclude(&chosen)
}

impl Case<'_> {
    fn conclude(self, chosen: &[usize]) -> JointFinding {
        let atoms = self.chosen_atoms(chosen);
        let structure = self.structure(chosen);
        let compliance = match self.record.ratio {
            None => Err("the file states no gear ratio"),
            Some(_) => compliance(&self.data, &self.noise, &atoms, structure, &self.atoms),
        };
        let has_rate = chosen.iter().any(|i| self.atoms[*i].kind == Kind::Rate);
        let delay = (has_rate || self.record.delay.is_some())
            .then(|| delay(&self.data, &self.noise, &atoms, &self.atoms, self.friction));
        let named = named::name(&self, chosen, delay, compliance.ok());
        let loud: Vec<usize> = chosen
            .iter()
            .copied()
            .filter(|i| !self.atoms[*i].kind.is_silent())
            .collect();
        let columns = self.columns(&loud);
        let a = amplitudes(&columns, &self.data.twist, &self.all());
        let left = residual(&columns, &a, &self.data.twist);
        let explained: Vec<f64> = self
            .data
            .twist
            .iter()
            .zip(&left)
            .map(|(y, l)| y - l)
            .collect();
        let simulated = self.simulated();
        let missed: Vec<f64> = self
            .data
            .twist
            .iter()
            .zip(&simulated)
            .map(|(y, s)| y - s)
            .collect();
        let noise_rms = self.noise.colour.rms.min(rms(&left));
        let share_left =
            ((rms(&left).powi(2) - noise_rms * noise_rms) / rms(&missed).powi(2)).clamp(0.0, 1.0);
        let p_value = self.lack_of_fit(&loud);
        JointFinding {
            site: self.record.site(),
            place: description::place(&missed, &self.data),
            description: self.describe(chosen),
            is_left: p_value < SIGNIFICANT && share_left > SHARE_LEFT,
            candidates: self.table(),
            noise: self.noise.colour.describe(),
            declared: self.record.delay,
            data: self.data,
            simulated,
            explained,
            named,
            delay,
            compliance,
            noise_rms,
            share_left,
            p_value,
        }
    }

    fn describe(&self, chosen: &[usize]) -> Option<String> {
        let silent: Vec<usize> = chosen
            .iter()
            .copied()
            .filter(|i| self.atoms[*i].kind.is_silent())
            .collect();
        let sized: Vec<(&Atom, f64)> = silent
            .iter()
            .map(|i| (&self.atoms[*i], self.size(chosen, *i)))
            .collect();
        description::left(&sized, self.record.ratio)
    }

    /// The nominal spring under the motor's torque, its zero free; without one the best spring.
    fn simulated(&self) -> Vec<f64> {
        let torque = &self.data.torque;
        let middle = super::channels::mean(torque);
        match self.nominal.stiffness {
            Some(k) => torque.iter().map(|t| -(t - middle) / k).collect(),
            None => {
                let columns = [self.evidence.ones(), torque.as_slice()];
                let a = amplitudes(&columns, &self.data.twist, &self.all());
                torque.iter().map(|t| a[0] + a[1] * t).collect()
            }
        }
    }

    /// Probability that chance leaves what the saturated span still finds.
    fn lack_of_fit(&self, set: &[usize]) -> f64 {
        let nats = self.evidence.set(set, &self.atoms).map_or(0.0, |s| s.nats);
        let excess = self.evidence.base - 2.0 * nats - self.noise.saturated;
        let used: usize = 3 + set
            .iter()
            .map(|i| self.atoms[*i].columns.len())
            .sum::<usize>();
        let freedom = self.noise.dimension.saturating_sub(used).max(1) as f64;
        ChiSquared::new(freedom).map_or(1.0, |d| d.sf(excess.max(0.0)))
    }

    fn table(&self) -> Vec<Candidate> {
        let top = self.sets.first().map_or(0.0, |s| s.1.score);
        let total: f64 = self.sets.iter().map(|s| (s.1.score - top).exp()).sum();
        let site = self.record.site();
        self.sets
            .iter()
            .take(4)
            .map(|(kinds, set)| {
                let names = kinds
                    .iter()
                    .map(|k| format!("{} {site}", named::spoken(*k)));
                (names.collect(), (set.score - top).exp() / total, set.nats)
            })
            .collect()
    }
}
