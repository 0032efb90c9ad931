//! A joint as the common engine sees it: the twist, its noise, and everybody who may be to blame.

use super::channels::{Channels, mean, range};
use super::columns::{Atom, Kind, atoms, base, sharp_steps, step, step_reach};
use super::joint::Nominal;
use super::next;
use super::noise::{Noise, Shared};
use super::ripple::ripples;
use super::stiffness::{Friction, friction};
use super::unseen::{Split, amplitudes, residual};
use crate::findings::engine::{
    Blamed, Experiment, Member, Nuisance, Remaining, Statement, Suspect,
};
use crate::inference::gaussian::Size;
use crate::measurement::joint_motion::JointRecord;
use std::sync::Arc;

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
    pub noise: Arc<Noise>,
    /// Friction that the torque shows.
    pub friction: Friction,
}

/// Orders of the generic structure over the angle and over time.
const OVER_ANGLE: usize = 24;
const OVER_TIME: usize = 30;

impl<'a> Case<'a> {
    /// From a record.
    pub fn new(record: &'a JointRecord, nominal: Nominal) -> Self {
        let data = Channels::of(record);
        let mut atoms = atoms(&data);
        let rough = rough_residual(&data, &atoms);
        atoms.extend(sharp_steps(&data, &rough));
        atoms.extend(ripples(&data, &rough, record.ratio));
        Self {
            noise: Arc::new(Noise::of(&data, &atoms)),
            friction: friction(&data),
            record,
            nominal,
            data,
            atoms,
        }
    }

    /// The atom behind a cause that the engine chose.
    pub fn atom(&self, blamed: &Blamed) -> Atom {
        match Kind::named(blamed.effect) {
            Some(Kind::Offset) => step(&self.data, blamed.shape[1] as usize),
            _ => self.atoms[blamed.shape[0] as usize].clone(),
        }
    }

    /// One suspect for every kind, its atoms as members; a jump near the row where one was found.
    fn suspects(&self, about: &[Blamed]) -> Vec<Suspect> {
        let jump = about.iter().find(|b| b.effect == Kind::Offset.effect());
        let near: Vec<Atom> = jump.map_or_else(Vec::new, |b| self.near(b.shape[1] as usize));
        let of = |kind: Kind| {
            let fine = kind == Kind::Offset && !near.is_empty();
            let own: Vec<(usize, &Atom)> = match fine {
                true => near.iter().enumerate().collect(),
                false => self
                    .atoms
                    .iter()
                    .enumerate()
                    .filter(|(_, a)| a.kind == kind)
                    .collect(),
            };
            Suspect {
                effect: kind.effect(),
                site: self.record.site(),
                summary: super::named::summary(kind.effect()),
                mechanism: kind.effect(),
                share: 0.0,
                members: own.into_iter().map(|(i, a)| member(i, a)).collect(),
            }
        };
        let all = Kind::ALL.into_iter().map(of);
        all.filter(|s| !s.members.is_empty()).collect()
    }

    /// Jumps at every row about one: the grid's error looks like a second cause.
    fn near(&self, row: usize) -> Vec<Atom> {
        let reach = step_reach(&self.data).max(1);
        let rows = row.saturating_sub(reach).max(2)..(row + reach).min(self.data.rows() - 2);
        let thin = (2 * reach / 40).max(1);
        rows.step_by(thin).map(|at| step(&self.data, at)).collect()
    }

    /// Structure of any kind: over the angle, over time, and powers of what moves the joint.
    fn span(&self) -> Vec<Vec<f64>> {
        let n = self.data.rows();
        let (low, high) = range(&self.data.motor);
        let turn = |q: f64| (q - low) / (high - low).max(f64::MIN_POSITIVE);
        let wave = |k: usize, x: f64| (std::f64::consts::PI * k as f64 * x).cos() / k as f64;
        let angle =
            (1..=OVER_ANGLE).map(|k| self.data.motor.iter().map(|q| wave(k, turn(*q))).collect());
        let time = (1..=OVER_TIME).map(|k| {
            (0..n)
                .map(|i| wave(k, (i as f64 + 0.5) / n as f64))
                .collect()
        });
        angle.chain(time).collect()
    }
}

fn member(index: usize, atom: &Atom) -> Member {
    Member {
        columns: atom.columns.clone(),
        size: Size::Free,
        positive: atom.one_signed.then(|| vec![1.0; atom.columns.len()]),
        shape: vec![index as f64, atom.shape],
    }
}

impl Experiment for Case<'_> {
    fn unit(&self) -> &'static str {
        "rad"
    }

    fn is_linear(&self) -> bool {
        false // the instant of a jump
    }

    fn state(&self, about: &[Blamed]) -> Statement {
        let rows = self.data.rows();
        let flat = |column| Nuisance {
            column,
            spread: f64::INFINITY,
        };
        Statement {
            reading: self.data.twist.clone(),
            noise: Box::new(Shared::of(&self.noise, rows)),
            nuisances: base(&self.data).into_iter().map(flat).collect(),
            suspects: self.suspects(about),
            span: self.span(),
            splits: [Split::Long, Split::Short]
                .map(|s| (0..rows).map(|i| s.fold(i, rows)).collect())
                .to_vec(),
        }
    }

    /// Named after the engine: they need the compliance.
    fn parameters(&self, _: &Blamed) -> Vec<(&'static str, f64, &'static str)> {
        Vec::new()
    }

    fn would_tell(&self, rivals: &[(&'static str, String)]) -> String {
        let kinds: Vec<Kind> = rivals.iter().filter_map(|r| Kind::named(r.0)).collect();
        let spoken: Vec<Kind> = kinds.into_iter().filter(|k| !k.is_silent()).collect();
        match spoken[..] {
            [a, b, ..] => next::would_tell(a, b).into(),
            _ => next::would_tell(Kind::Position, Kind::Mesh).into(),
        }
    }

    fn place(&self, missed: &[f64]) -> String {
        super::description::place(missed, &self.data).into()
    }

    /// Told by the finding of the joint, with its silent terms.
    fn remaining(&self, _: &[f64]) -> Remaining {
        Remaining::default()
    }
}

/// The nominal spring under the motor's torque, its zero free; without one the best spring.
pub(super) fn simulated(data: &Channels, nominal: Nominal) -> Vec<f64> {
    let middle = mean(&data.torque);
    match nominal.stiffness {
        Some(k) => data.torque.iter().map(|t| -(t - middle) / k).collect(),
        None => {
            let ones = vec![1.0; data.rows()];
            let a = amplitudes(&[&ones, &data.torque], &data.twist, &all(data));
            data.torque.iter().map(|t| a[0] + a[1] * t).collect()
        }
    }
}

/// Every row.
pub(super) fn all(data: &Channels) -> Vec<usize> {
    (0..data.rows()).collect()
}

/// What zero, torque, acceleration, speed, friction and slow structure leave.
fn rough_residual(data: &Channels, atoms: &[Atom]) -> Vec<f64> {
    let plain = [Kind::Rate, Kind::Coulomb, Kind::Backlash, Kind::Position];
    let own = atoms.iter().filter(|a| plain.contains(&a.kind));
    let mut columns = base(data);
    columns.extend(own.flat_map(|a| a.columns.iter().cloned()));
    let columns: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
    let a = amplitudes(&columns, &data.twist, &all(data));
    residual(&columns, &a, &data.twist)
}
