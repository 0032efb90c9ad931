//! A spring that a motion does not show: torque that pays for inertia and friction alone, as where gravity loads no joint. The
//! inertia of the rotor, which nobody states, would make any twist of it, so that the spring of the simulation, as well as it
//! is known, takes the place of one that is fitted.

use super::channels::Channels;
use super::coulomb_friction::dry;
use super::joint::{Joint, Nominal, TORQUE, base};
use super::projection::left;
use crate::ground::stats::{mean, rms};

/// Share of the torque, rms, that inertia and friction must leave of it: laws of friction miss less.
const OWN: f64 = 0.1;

/// Compliance that is presumed, rad/(N·m); none where the motion shows one, or nobody says any.
pub(super) fn presumed(data: &Channels, ratio: Option<f64>, nominal: Nominal) -> Option<f64> {
    let stiffness = nominal.stiffness.filter(|_| ratio.is_some())?;
    let mut beside = base(data);
    beside.remove(TORQUE);
    beside.push(data.speed.clone());
    beside.extend(dry(data));
    let middle = mean(&data.torque);
    let whole: Vec<f64> = data.torque.iter().map(|t| t - middle).collect();
    let is_shown = rms(&left(&beside, &data.torque)) > OWN * rms(&whole);
    (!is_shown).then_some(1.0 / stiffness)
}

impl Joint {
    /// The twist less that of a presumed spring, rad.
    pub(super) fn reading(&self) -> Vec<f64> {
        let compliance = self.presumed.unwrap_or(0.0);
        self.column(|i| self.data.twist[i] + compliance * self.data.torque[i])
    }

    /// Columns of every model of whose amounts nothing is known.
    pub(super) fn open(&self) -> Vec<Vec<f64>> {
        match self.presumed {
            Some(_) => self.beside_torque(),
            None => self.base(),
        }
    }

    /// Standard deviation of the twist per torque beside the reading, rad/(N·m).
    pub(super) fn spring_spread(&self) -> f64 {
        let known = |compliance: f64| compliance * self.nominal.rel_std.max(f64::EPSILON);
        self.presumed.map_or(f64::INFINITY, known)
    }

    /// Columns beside which a spring is told: where one is presumed, of a rotor without inertia, which makes it as stiff as
    /// it can be.
    pub(super) fn beside_spring(&self) -> Vec<Vec<f64>> {
        let mut columns = self.base();
        if self.presumed.is_some() {
            columns.remove(ACCELERATION);
        }
        columns.remove(TORQUE);
        columns
    }
}

/// Place of the acceleration among the columns that every model has.
const ACCELERATION: usize = 2;
