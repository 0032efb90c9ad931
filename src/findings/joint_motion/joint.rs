//! The diagnosis of one joint: from its record to what is named and what is left.

use super::channels::{Channels, rms};
use super::columns::{Atom, Kind, atoms, base, sharp_steps, step, step_reach};
use super::delay::{Delay, delay};
use super::evidence::{Evidence, Set, kinds};
use super::named::{self, Named};
use super::noise::Noise;
use super::ripple::ripples;
use super::stiffness::{Compliance, Friction, compliance, friction};
use super::unseen::{Split, amplitudes, gain, held_out, residual};
use super::{description, next};
use crate::findings::answer::{Candidate, Group};
use crate::findings::gain::Gain;
use crate::measurement::joint_motion::JointRecord;
use statrs::distribution::{ChiSquared, ContinuousCDF};

/// A stand-in with at least this share of the winner's score cannot be ruled out.
const AMBIGUOUS: f64 = 0.05;
/// Probability of a set against the same set less one cause, below which that cause is not named.
const NEEDED: f64 = 0.9;
/// Share of the variance of what torque and inertia leave that a cause must explain to be named.
const MATTERS: f64 = 0.01;
/// The same for a jump of a zero and a ripple, which slow structure and meshing teeth imitate in part.
const INSTRUMENT_MATTERS: f64 = 0.12;
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

/// Everything that is known of a joint before causes are named.
pub(super) struct Case<'a> {
    pub record: &'a JointRecord,
    pub nominal: Nominal,
    pub data: Channels,
    pub atoms: Vec<Atom>,
    pub noise: Noise,
    pub evidence: Evidence,
    pub sets: Vec<(Vec<Kind>, Set)>,
    pub friction: Friction,
}

/// Diagnoses one joint.
pub fn diagnose_joint(record: &JointRecord, nominal: Nominal) -> JointFinding {
    let case = Case::new(record, nominal);
    let chosen = case.choose();
    case.conclude(&chosen)
}

impl<'a> Case<'a> {
    fn new(record: &'a JointRecord, nominal: Nominal) -> Self {
        let data = Channels::of(record);
        let mut atoms = atoms(&data);
        let rough = rough_residual(&data, &atoms);
        atoms.extend(sharp_steps(&data, &rough));
        atoms.extend(ripples(&data, &rough, record.ratio));
        let noise = Noise::of(&data, &atoms);
        let evidence = Evidence::new(&data, &atoms, &noise);
        let sets = evidence.search(&atoms);
        let mut case = Self {
            friction: friction(&data),
            record,
            nominal,
            data,
            atoms,
            noise,
            evidence,
            sets,
        };
        case.refine_step();
        case
    }

    /// The instant of a jump to the row: the grid's error looks like a second cause.
    fn refine_step(&mut self) {
        let best = self
            .sets
            .first()
            .map(|s| s.1.atoms.clone())
            .unwrap_or_default();
        let Some(rough) = best.iter().find(|i| self.atoms[**i].kind == Kind::Offset) else {
            return;
        };
        let others: Vec<usize> = best.iter().copied().filter(|i| i != rough).collect();
        let (row, reach) = (self.atoms[*rough].shape as usize, step_reach(&self.data));
        let errors = |at: usize| {
            let atom = step(&self.data, at);
            let mut columns = self.columns(&others);
            let own: &[f64] = &atom.columns[0];
            columns.push(own);
            let a = amplitudes(&columns, &self.data.twist, &self.all());
            rms(&residual(&columns, &a, &self.data.twist))
        };
        let near = row.saturating_sub(reach).max(2)..(row + reach).min(self.data.rows() - 2);
        let finest = near.min_by(|a, b| errors(*a).total_cmp(&errors(*b)));
        self.atoms[*rough] = step(&self.data, finest.unwrap_or(row));
        self.evidence = Evidence::new(&self.data, &self.atoms, &self.noise);
        self.sets = self.evidence.search(&self.atoms);
    }

    pub fn all(&self) -> Vec<usize> {
        (0..self.data.rows()).collect()
    }

    /// Columns of zero, torque and acceleration, and of a set of atoms.
    pub fn columns(&self, indices: &[usize]) -> Vec<&[f64]> {
        let mut columns: Vec<&[f64]> = vec![self.evidence.ones()];
        columns.extend([
            self.data.torque.as_slice(),
            self.data.acceleration.as_slice(),
        ]);
        let own = indices.iter().flat_map(|i| self.atoms[*i].columns.iter());
        columns.extend(own.map(Vec::as_slice));
        columns
    }

    pub fn chosen_atoms(&self, indices: &[usize]) -> Vec<&Atom> {
        indices.iter().map(|i| &self.atoms[*i]).collect()
    }

    /// Rms that an atom contributes within a set.
    pub fn size(&self, indices: &[usize], index: usize) -> f64 {
        let a = amplitudes(&self.columns(indices), &self.data.twist, &self.all());
        let before = indices.iter().take_while(|i| **i != index);
        let at = 3 + before.map(|i| self.atoms[*i].columns.len()).sum::<usize>();
        let columns = &self.atoms[index].columns;
        let own: Vec<f64> = (0..self.data.rows())
            .map(|i| {
                columns
                    .iter()
                    .enumerate()
                    .map(|(k, c)| a[at + k] * c[i])
                    .sum()
            })
            .collect();
        let mean = super::channels::mean(&own);
        rms(&own.iter().map(|v| v - mean).collect::<Vec<f64>>())
    }

    /// Amplitudes of an atom within a set.
    pub fn amplitudes_of(&self, indices: &[usize], index: usize) -> Vec<f64> {
        let a = amplitudes(&self.columns(indices), &self.data.twist, &self.all());
        let before = indices.iter().take_while(|i| **i != index);
        let at = 3 + before.map(|i| self.atoms[*i].columns.len()).sum::<usize>();
        a[at..at + self.atoms[index].columns.len()].to_vec()
    }

    /// The most probable set, less the causes that gain nothing on unseen data.
    fn choose(&self) -> Vec<usize> {
        let mut chosen = self
            .sets
            .first()
            .map(|s| s.1.atoms.clone())
            .unwrap_or_default();
        loop {
            let loss = |i: &usize| self.score(&chosen) - self.score(&without(&chosen, *i));
            let unreal = chosen
                .iter()
                .copied()
                .filter(|i| !self.is_real(&chosen, *i));
            match unreal.min_by(|a, b| loss(a).total_cmp(&loss(b))) {
                None => return chosen,
                Some(index) => chosen.retain(|i| *i != index),
            }
        }
    }

    fn is_real(&self, chosen: &[usize], index: usize) -> bool {
        if self.atoms[index].kind.is_silent() {
            return true;
        }
        let rest = without(chosen, index);
        let share = (self.size(chosen, index) / self.unsprung()).powi(2);
        let matters = match self.atoms[index].kind {
            Kind::Offset | Kind::Ripple => INSTRUMENT_MATTERS,
            _ => MATTERS,
        };
        share > matters && self.is_needed(chosen, &rest) && self.gain(chosen, index).is_real()
    }

    /// Rms of the twist that torque and inertia leave.
    fn unsprung(&self) -> f64 {
        let columns = self.columns(&[]);
        let a = amplitudes(&columns, &self.data.twist, &self.all());
        rms(&residual(&columns, &a, &self.data.twist))
    }

    fn score(&self, indices: &[usize]) -> f64 {
        let found = self
            .sets
            .iter()
            .find(|s| s.0 == kinds(indices, &self.atoms));
        found.map_or(f64::MIN, |s| s.1.score)
    }

    fn is_needed(&self, chosen: &[usize], rest: &[usize]) -> bool {
        self.score(chosen) - self.score(rest) > (NEEDED / (1.0 - NEEDED)).ln()
    }

    /// Gain of one atom of a set on long pieces of time that were not fitted. What the gear does may
    /// show in few places: then on short pieces, if the long ones do not show it.
    pub fn gain(&self, chosen: &[usize], index: usize) -> Gain {
        let rest = without(chosen, index);
        let on = |split: Split| {
            let errors = |set: &[usize]| held_out(&self.columns(set), &self.data, split);
            gain(&errors(&rest), &errors(chosen), split)
        };
        let long = on(Split::Long);
        let gear = matches!(
            self.atoms[index].kind,
            Kind::Backlash | Kind::Hysteresis | Kind::Coulomb
        );
        if long.is_real() || !gear {
            return long;
        }
        let short = on(Split::Short);
        if short.is_real() { short } else { long }
    }

    /// Kinds that can stand in for one of the chosen, with their probability against it.
    pub fn stand_ins(&self, chosen: &[usize], index: usize) -> Vec<(Kind, f64)> {
        let own = self.score(chosen);
        let others = without(chosen, index);
        let rest = kinds(&others, &self.atoms);
        let mut found = Vec::new();
        for (with, set) in &self.sets {
            let mut extra = with.clone();
            for kind in &rest {
                if let Some(at) = extra.iter().position(|k| k == kind) {
                    extra.remove(at);
                }
            }
            let one = extra.len() == 1 && with.len() == rest.len() + 1;
            let odds = (set.score - own).exp();
            if one && extra[0] != self.atoms[index].kind && odds >= AMBIGUOUS {
                found.push((extra[0], odds / (1.0 + odds)));
            }
        }
        found
    }

    fn structure(&self, chosen: &[usize]) -> f64 {
        let position = self.atoms.iter().position(|a| a.kind == Kind::Position);
        let nats = |set: &[usize]| self.evidence.set(set, &self.atoms).map_or(0.0, |s| s.nats);
        position.map_or(0.0, |p| {
            let mut more: Vec<usize> = chosen.iter().copied().filter(|i| *i != p).collect();
            let less = nats(&more);
            more.push(p);
            nats(&more) - less
        })
    }

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

    /// A group of causes that these data do not separate.
    pub fn group(&self, effects: Vec<&'static str>, kinds: (Kind, Kind), gain: Gain) -> Group {
        Group {
            sites: vec![self.record.site(); effects.len()],
            effects,
            would_tell: next::would_tell(kinds.0, kinds.1).into(),
            gain,
        }
    }
}

/// A set less one of its atoms.
pub(super) fn without(set: &[usize], index: usize) -> Vec<usize> {
    set.iter().copied().filter(|i| *i != index).collect()
}

/// What zero, torque, acceleration, speed, friction and slow structure leave.
fn rough_residual(data: &Channels, atoms: &[Atom]) -> Vec<f64> {
    let plain = |kind| {
        matches!(
            kind,
            Kind::Rate | Kind::Coulomb | Kind::Backlash | Kind::Position
        )
    };
    let mut columns = base(data);
    columns.extend(
        atoms
            .iter()
            .filter(|a| plain(a.kind))
            .flat_map(|a| a.columns.iter().cloned()),
    );
    let columns: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
    let rows: Vec<usize> = (0..data.rows()).collect();
    let a = amplitudes(&columns, &data.twist, &rows);
    residual(&columns, &a, &data.twist)
}
