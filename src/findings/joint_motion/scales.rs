//! What no column of a joint tells: a stiffness that is not the simulation's, and a constant zero.

use super::experiment::judgement;
use super::joint::Joint;
use super::sensor_offset;
use super::stiffness::Compliance;
use crate::findings::answer::Cause;
use crate::findings::engine::bank::Bank;
use crate::findings::engine::unseen::gains;
use crate::findings::engine::{Aspects, Member, Nuisance, Statement};
use crate::findings::gain::Gain;
use crate::findings::table::{Effect, Parameters};
use crate::ground::stats::{Z95, mean, rms};

/// Told from the record as a whole, so that it has no place among the columns.
pub(super) const STIFFNESS: Effect<Joint> = Effect {
    name: "stiffness",
    summary: "The stiffness that the simulation uses is not the joint's.",
    mechanism: "spring",
    law_error: 0.0,
    can_be: |_, _| true,
    places: |_| Vec::new(),
    parameters: |_, _| Vec::new(),
    would_tell: super::remarks::FOR_STIFFNESS,
};

impl Joint {
    fn scale(&self, effect: &Effect<Joint>, parameters: Parameters, gain: Gain) -> Option<Cause> {
        let cause = Cause {
            effect: effect.name,
            site: self.site.clone(),
            probability: gain.probability().min(judgement().certain),
            summary: effect.summary,
            alternatives: Vec::new(),
            ci95: Vec::new(),
            parameters,
            gain,
        };
        gain.is_real().then_some(cause)
    }

    /// The stiffness, where the data fix it and it is not the one the simulation uses.
    pub(super) fn other_stiffness(&self, found: Compliance, parts: &[Vec<f64>]) -> Option<Cause> {
        let nominal = self.nominal.stiffness?;
        let log = (found.value * nominal).ln().abs();
        if log < Z95 * (found.std / found.value).hypot(self.nominal.rel_std) {
            return None;
        }
        let gain = self.gain_of_spring(nominal, parts)?;
        let parameters = vec![("stiffness", 1.0 / found.value, "N·m/rad")];
        self.scale(&STIFFNESS, parameters, gain)
    }

    /// What another spring gains on pieces of time that were not fitted, beside all parts.
    fn gain_of_spring(&self, nominal: f64, parts: &[Vec<f64>]) -> Option<Gain> {
        let torque = &self.data.torque;
        let read = |i: usize| self.data.twist[i] + torque[i] / nominal;
        let free = |column: &Vec<f64>| Nuisance {
            column: column.clone(),
            spread: f64::INFINITY,
        };
        let mut spring = self.suspects().into_iter().next()?;
        spring.members = vec![Member::free(torque.clone())];
        let statement = Statement {
            reading: self.column(read),
            noise: Box::new(self.noise.clone()),
            nuisances: [&self.beside_spring(), parts]
                .concat()
                .iter()
                .map(free)
                .collect(),
            suspects: vec![spring],
            span: Vec::new(),
            splits: self.splits(),
            aspects: Aspects::default(),
        };
        let bank = Bank::new(&statement);
        let fit = bank.fit(&[0])?;
        gains(&statement, &bank, &fit, 0.0).first().copied()
    }

    /// A constant difference of the encoders, where the file says how well their zeros agree: beyond what the spring, as the
    /// motion shows it, makes of the mean torque, and what causes have for a mean. What is `left` has a mean as well, and so has what contacts held before the
    /// record: anything up to what they are seen to hold, of either sign, and loops are seen too narrow, so that `held` is its standard deviation.
    pub(super) fn zero(
        &self,
        spring: Option<Compliance>,
        parts: &[Vec<f64>],
        held: f64,
        (noise, left): (f64, f64),
    ) -> Option<Cause> {
        let std = self.zero_std?;
        let torque = mean(&self.data.torque);
        let (compliance, known) = match (spring, self.nominal.stiffness) {
            (Some(c), _) => (c.value, c.std),
            (None, Some(stiffness)) => (1.0 / stiffness, SLACK / stiffness),
            (None, None) if torque.abs() < NIL * rms(&self.data.torque) => (0.0, 0.0),
            // what the weight twists would be the encoders'
            (None, None) => return None,
        };
        let made: f64 = parts.iter().map(|part| mean(part)).sum();
        let offset = self.data.zero + compliance * torque - made;
        let others = [known * torque, MADE * made, held, left];
        if offset.abs() < 3.0 * others.into_iter().fold(std, f64::hypot) {
            return None;
        }
        let gain = Gain::of(offset.hypot(noise), std.hypot(noise), std / offset.abs());
        self.scale(
            &sensor_offset::EFFECT,
            vec![("offset", offset, "rad")],
            gain,
        )
    }
}

/// Share of the torque, rms, below which its mean twists no spring: nothing weighs on the joint. A choice.
const NIL: f64 = 0.02;
/// Share of its compliance to which a spring is known that the motion does not show.
const SLACK: f64 = 0.3;
/// Share to which the mean of a cause is known: its shape is nearly right, and what a friction held first nobody knows.
const MADE: f64 = 0.3;
