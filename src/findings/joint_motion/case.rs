//! A joint before anything is named: its candidates, their evidence, and what each gains unseen.

use super::channels::{Channels, rms};
use super::columns::{Atom, Kind, atoms, base, sharp_steps, step, step_reach};
use super::evidence::{Evidence, Set, kinds};
use super::joint::Nominal;
use super::next;
use super::noise::Noise;
use super::ripple::ripples;
use super::stiffness::{Friction, friction};
use super::unseen::{Split, amplitudes, gain, held_out, residual};
use crate::findings::answer::Group;
use crate::findings::gain::Gain;
use crate::measurement::joint_motion::JointRecord;

/// A stand-in with at least this share of the winner's score cannot be ruled out.
const AMBIGUOUS: f64 = 0.05;
/// Probability of a set against the same set less one cause, below which that cause is not named.
const NEEDED: f64 = 0.9;
/// Share of the variance of what torque and inertia leave that a cause must explain to be named.
const MATTERS: f64 = 0.01;
/// Share of the variance of what all other causes leave that a jump of a zero or a ripple must explain.
const INSTRUMENT_MATTERS: f64 = 0.4;

/// Everything that is known of a joint before causes are named.
pub(super) struct Case<'a> {
    /// Its record.
    pub record: &'a JointRecord,
    /// The present simulation.
    pub nominal: Nominal,
    /// Its channels.
    pub data: Channels,
    /// Candidates.
    pub atoms: Vec<Atom>,
    /// The noise.
    pub noise: Noise,
    /// Normal equations.
    pub evidence: Evidence,
    /// Sets that were compared, best first.
    pub sets: Vec<(Vec<Kind>, Set)>,
    /// Friction that the torque shows.
    pub friction: Friction,
}

impl<'a> Case<'a> {
    /// From a record.
    pub fn new(record: &'a JointRecord, nominal: Nominal) -> Self {
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

    /// Every row.
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

    /// The atoms of a set.
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
    pub fn choose(&self) -> Vec<usize> {
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
        self.matters(chosen, &rest, index)
            && self.is_needed(chosen, &rest)
            && self.gain(chosen, index).is_real()
    }

    /// Whether an atom is large: beside what torque and inertia leave, or, for what slow structure
    /// imitates in part, beside what the rest of the set leaves.
    fn matters(&self, chosen: &[usize], rest: &[usize], index: usize) -> bool {
        match self.atoms[index].kind {
            Kind::Offset | Kind::Ripple => {
                let left = self.left(chosen) / self.left(rest).max(f64::MIN_POSITIVE);
                1.0 - left * left > INSTRUMENT_MATTERS
            }
            _ => (self.size(chosen, index) / self.left(&[])).powi(2) > MATTERS,
        }
    }

    /// Rms of the twist that torque, inertia and a set leave.
    fn left(&self, set: &[usize]) -> f64 {
        let columns = self.columns(set);
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

    /// Nats that slow structure over the angle would gain.
    pub fn structure(&self, chosen: &[usize]) -> f64 {
        let position = self.atoms.iter().position(|a| a.kind == Kind::Position);
        let nats = |set: &[usize]| self.evidence.set(set, &self.atoms).map_or(0.0, |s| s.nats);
        position.map_or(0.0, |p| {
            let mut more: Vec<usize> = chosen.iter().copied().filter(|i| *i != p).collect();
            let less = nats(&more);
            more.push(p);
            nats(&more) - less
        })
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
