//! A spring that a motion does not show: torque that pays for inertia and friction alone, as where gravity loads no joint. The
//! inertia of the rotor, which nobody states, would make any twist of it, so that the spring of the simulation, as well as it
//! is known, takes the place of one that is fitted; where nobody states any, or the twist is more than the stated one makes, the stiffest that
//! there can be.

use super::channels::Channels;
use super::coulomb_friction::dry;
use super::joint::{Joint, Nominal, TORQUE, base};
use super::projection::{left, partial};
use super::{backlash, hysteresis};
use crate::findings::engine::Blamed;
use crate::ground::stats::rms;

/// Share of the torque, rms about its mean, that must be left of it beside inertia and friction, or beside whatever a spring is told beside:
/// laws of friction miss less. A choice.
pub(super) const OWN: f64 = 0.1;

/// Standard errors that a slope over the acceleration must be away from none, as errors of rows that depend on one another are
/// larger than they say; and the share of a compliance to which dry friction must tell it. Choices.
const SEEN: f64 = 10.0;
const KNOWN: f64 = 0.1;
/// Standard deviations of a stated compliance beyond which twist denies it. A choice.
const DENIED: f64 = 3.0;
/// Relative standard deviation of a spring that is the stiffest there can be: of the slopes that it is told from. A choice.
const STIFFEST: f64 = 0.05;
/// The same where no friction of the link tells one: rotors of two fifths of what they move make it softer by two deviations. A choice.
const UNTOLD: f64 = 0.2;
/// The same where a gap or a loop was among them. A choice.
const MIXED: f64 = 0.5;

/// A spring that is presumed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Presumed {
    /// Compliance, rad/(N·m).
    pub compliance: f64,
    /// Its relative standard deviation.
    pub rel_std: f64,
    /// Whether the simulation states one, which is presumed where the twist is no more than it makes; else it is the stiffest with which the torque
    /// makes such a twist.
    pub is_stated: bool,
}

/// What is presumed; nothing where the motion shows a spring, or the twist none.
pub(super) fn presumed(data: &Channels, nominal: Nominal) -> Option<Presumed> {
    if rms(&beyond(data)) > OWN * data.torque_moves() {
        return None;
    }
    match nominal.stiffness {
        Some(stiffness) => Some(stated_one(data, 1.0 / stiffness, nominal.rel_std)),
        None => stiffest(data),
    }
}

/// The stated compliance; where the twist is more than it makes even of a rotor without inertia, the one that makes that: anything down
/// to the stated one lies within two deviations, since a gap makes such twist as well.
fn stated_one(data: &Channels, stated: f64, rel_std: f64) -> Presumed {
    let least = rigid(data).filter(|least| *least > stated * (1.0 + DENIED * rel_std));
    let compliance = least.unwrap_or(stated);
    Presumed {
        compliance,
        rel_std: rel_std.max(0.5 * (1.0 - stated / compliance)),
        is_stated: true,
    }
}

/// What inertia and friction leave of the torque, N·m.
fn beyond(data: &Channels) -> Vec<f64> {
    let mut beside = without_inertia(data);
    beside.push(data.acceleration.clone());
    left(&beside, &data.torque)
}

/// Zero, friction by any of its laws, and what smoothing takes.
fn without_inertia(data: &Channels) -> Vec<Vec<f64>> {
    let mut columns = base(data);
    columns.remove(ACCELERATION);
    columns.remove(TORQUE);
    columns.push(data.speed.clone());
    columns.extend(dry(data));
    columns
}

/// Stiffest spring with which the torque makes such a twist: of a rotor without inertia, by the twist over the torque of the
/// acceleration, since the rotor's share of that torque makes the spring softer, never stiffer; or a softer one, where friction of the
/// link makes twist beyond that. A spring without compliance would leave a twist that nothing makes.
fn stiffest(data: &Channels) -> Option<Presumed> {
    let rigid = rigid(data)?;
    let softer = by_friction(data, KNOWN * rigid);
    let told = softer.filter(|softer| *softer > rigid);
    let compliance = told.unwrap_or(rigid);
    let least = told.map_or(UNTOLD, |_| STIFFEST);
    Some(Presumed {
        compliance,
        // a gap makes such twist as well: anything down to the rigid rotor's lies within two deviations
        rel_std: least.max(0.5 * (1.0 - rigid / compliance)),
        is_stated: false,
    })
}

/// Compliance of a rotor without inertia, by the twist over the torque of the acceleration.
fn rigid(data: &Channels) -> Option<f64> {
    let beside = without_inertia(data);
    let twist = told(&beside, &data.acceleration, &data.twist);
    let torque = told(&beside, &data.acceleration, &data.torque);
    let is_seen = twist.is_seen() && torque.is_seen();
    let rigid = -twist.slope / torque.slope;
    (is_seen && rigid > 0.0).then_some(rigid)
}

/// Compliance by the twist over friction that the torque shows: by dry friction alone, where it tells one to within an error, so that a
/// late encoder makes none of it; else by all of it, where that tells any.
fn by_friction(data: &Channels, error: f64) -> Option<f64> {
    let mut beside = base(data);
    beside.remove(TORQUE);
    let all = told(&beside, &data.torque, &data.twist);
    beside.push(data.speed.clone());
    let dry = told(&beside, &data.torque, &data.twist);
    match dry.error < error {
        true => Some(-dry.slope),
        false => all.is_seen().then_some(-all.slope),
    }
}

/// A slope with its standard error.
struct Told {
    slope: f64,
    error: f64,
}

impl Told {
    fn is_seen(&self) -> bool {
        self.slope.abs() > SEEN * self.error
    }
}

fn told(beside: &[Vec<f64>], channel: &[f64], reading: &[f64]) -> Told {
    let found = partial(beside, channel, reading);
    let all = [beside, &[channel.to_vec()]].concat();
    Told {
        slope: found.slope,
        error: rms(&left(&all, reading)) / found.square.sqrt(),
    }
}

impl Joint {
    /// The twist less that of a presumed spring, rad.
    pub(super) fn reading(&self) -> Vec<f64> {
        let compliance = self.presumed_compliance();
        self.column(|i| self.data.twist[i] + compliance * self.data.torque[i])
    }

    /// Compliance that is presumed, rad/(N·m); 0 without one.
    pub(super) fn presumed_compliance(&self) -> f64 {
        self.presumed.map_or(0.0, |p| p.compliance)
    }

    /// Columns of every model of whose amounts nothing is known.
    pub(super) fn open(&self) -> Vec<Vec<f64>> {
        match self.presumed {
            Some(_) => self.beside_torque(),
            None => self.base(),
        }
    }

    /// Standard deviation of the twist per torque beside the reading, rad/(N·m). Slopes that told a spring nobody states told that of
    /// a gap or a loop with it.
    pub(super) fn spring_spread(&self, about: &[Blamed]) -> f64 {
        let follows = [backlash::EFFECT.name, hysteresis::EFFECT.name];
        let is_mixed = about.iter().any(|b| follows.contains(&b.effect));
        let known = |p: Presumed| {
            let mixed = if is_mixed && !p.is_stated { MIXED } else { 0.0 };
            p.compliance * p.rel_std.max(mixed).max(f64::EPSILON)
        };
        self.presumed.map_or(f64::INFINITY, known)
    }

    /// What a spring makes of torque that is neither inertia nor friction: any, since where the stiffest is presumed the true one is
    /// softer by what nobody knows, and since noise of the torque would else pay for what follows speed and acceleration, which
    /// have none: a late encoder, a loop.
    pub(super) fn beyond_motion(&self) -> Option<Vec<f64>> {
        self.presumed.map(|_| beyond(&self.data))
    }

    /// Columns beside which a spring is told: where one is presumed, of a rotor without inertia, which makes it as stiff as
    /// it can be.
    pub(super) fn beside_spring(&self) -> Vec<Vec<f64>> {
        let mut columns = self.base();
        if self.presumed.is_some_and(|p| p.is_stated) {
            columns.remove(ACCELERATION);
        }
        columns.remove(TORQUE);
        columns
    }
}

/// Place of the acceleration among the columns that every model has.
const ACCELERATION: usize = 2;
