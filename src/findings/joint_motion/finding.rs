//! The diagnosis of one joint: what the engine found in it, its scales, and its figures.

use super::channels::Channels;
use super::delay::{Delay, delay};
use super::experiment::judgement;
use super::hysteresis;
use super::joint::{Joint, Nominal};
use super::patterns::{BENT, MESHING};
use super::projection;
use super::remarks::FOR_STIFFNESS;
use super::stiffness::{Compliance, compliance};
use crate::findings::answer::{Answer, Cause, Group, Verdict};
use crate::findings::engine::{Experiment, Found, diagnose};
use crate::findings::gain::Gain;
use crate::ground::stats::{difference, mean, rms};
use crate::measurement::joint_motion::JointRecord;
use crate::sheet::number::significant;

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
    /// Its answer.
    pub answer: Answer,
    /// The delay, where one is named.
    pub delay: Option<Delay>,
    /// The compliance, or why there is none.
    pub compliance: Result<Compliance, &'static str>,
    /// Inertia of a rotor, as a share of the inertia that the joint moves, with which the stated spring twists as seen.
    pub rotor: Option<f64>,
    /// What is seen and not named, in words.
    pub seen: Option<String>,
}

impl JointFinding {
    /// What the named causes leave of the twist, rad.
    pub fn residual(&self) -> Vec<f64> {
        difference(&self.data.twist, &self.explained)
    }
}

/// Why a motion shows no spring whose torque pays for inertia and friction alone.
const ROTOR: &str = "the torque pays for inertia and friction alone, so that the inertia of the rotor would make the same twist";

/// Times the stated stiffness up to which a motion that shows no spring may have one: behind a rotor with as much inertia as what it moves, as
/// gears of 100 and more make it. Of 200 files by a stranger 17 had such a stiffness as what cannot be told, all of them rotors.
const HEAVIEST: f64 = 2.0;

/// Diagnoses one joint.
pub fn diagnose_joint(record: &JointRecord, nominal: Nominal) -> JointFinding {
    let joint = Joint::new(record, nominal);
    let Found {
        mut answer,
        blamed,
        doubted,
        left,
        ..
    } = diagnose(&joint, &judgement());
    keep_the_surer(&mut answer);
    let beside = || blamed.iter().chain(&doubted);
    let others = |effect: &str| -> Vec<Vec<f64>> {
        let others = beside().filter(|b| b.effect != effect);
        others.map(|b| b.part.clone()).collect()
    };
    let has = |effect: &str| answer.causes.iter().any(|c| c.effect == effect);
    let spring = match answer.unexplained.description == BENT {
        true => Err("the twist bends with the torque, so that there is no one stiffness"),
        false => compliance(&joint, &others("")),
    };
    let stated = joint.presumed.filter(|p| p.is_stated);
    let told = match stated {
        Some(_) => Err(ROTOR),
        None => spring.map_err(|why| joint.presumed.map_or(why, |_| ROTOR)),
    };
    let delay = has("time_skew").then(|| delay(&joint, &others("time_skew")));
    let loops: Vec<f64> = beside()
        .filter(|b| b.effect == hysteresis::EFFECT.name)
        .map(|b| b.amounts[0].abs())
        .collect();
    answer
        .causes
        .iter_mut()
        .for_each(|c| tell(c, told.ok(), delay));
    let mut rotor = None;
    let held = loops.iter().sum();
    let zero = joint.zero(told.ok(), &others(""), held, sizes(&answer, &left));
    zero.into_iter().for_each(|s| add(&mut answer, s));
    // a loop has no one stiffness
    if let Some(c) = spring.ok().filter(|_| loops.is_empty()) {
        let times = joint.nominal.stiffness.map_or(1.0, |k| 1.0 / (c.value * k));
        let other = joint.other_stiffness(c, &others(""));
        let is_stiffer = stated.is_some() && times > 1.0;
        rotor = other.as_ref().filter(|_| is_stiffer).map(|_| times - 1.0);
        match other {
            Some(_) if is_stiffer && times < HEAVIEST => {}
            Some(s) if is_stiffer => ask(&mut answer, s),
            Some(s) => add(&mut answer, s),
            None => {}
        }
    }
    let simulated = joint.simulated();
    let missed = difference(&joint.data.twist, &simulated);
    answer.discrepancy.rms = rms(&missed);
    answer.discrepancy.place = joint.place(&missed);
    JointFinding {
        site: joint.site.clone(),
        seen: joint.seen(&answer),
        explained: difference(&joint.data.twist, &left),
        simulated,
        answer,
        rotor,
        delay,
        compliance: told,
        data: joint.data,
    }
}

/// Where what is left is the story, a cause is named only if it explains more of the variance of unseen readings than
/// it leaves: what it misses may well be something else altogether, and gain as much.
fn keep_the_surer(answer: &mut Answer) {
    if answer.verdict == Verdict::UnknownCause {
        let is_surer = |gain: &Gain| gain.explained() > gain.after.powi(2);
        answer.causes.retain(|c| is_surer(&c.gain));
        answer.groups.retain(|g| is_surer(&g.gain));
    }
}

/// Names a cause beside what the engine found.
fn add(answer: &mut Answer, cause: Cause) {
    answer.causes.push(cause);
    answer.verdict = match answer.verdict {
        Verdict::Sufficient | Verdict::CannotTell => Verdict::Explained,
        Verdict::UnknownCause => Verdict::PartlyExplained,
        other => other,
    };
}

/// What may be a cause, or what nobody states.
fn ask(answer: &mut Answer, cause: Cause) {
    answer.groups.push(Group {
        effects: vec![cause.effect],
        sites: vec![cause.site],
        would_tell: FOR_STIFFNESS.into(),
        gain: cause.gain,
        probability: cause.probability,
    });
    if answer.verdict == Verdict::Sufficient {
        answer.verdict = Verdict::CannotTell;
    }
}

/// The noise, and what is left beyond it where more is wrong than is named, rms, rad.
fn sizes(answer: &Answer, left: &[f64]) -> (f64, f64) {
    let noise = answer.discrepancy.noise_rms;
    let is_open = answer.is_open();
    let beyond = (rms(left).powi(2) - noise * noise).max(0.0).sqrt();
    (noise, if is_open { beyond } else { 0.0 })
}

/// A delay as all accounts of the rest have it, and what is known as twist as the torque that it is.
fn tell(cause: &mut Cause, compliance: Option<Compliance>, delay: Option<Delay>) {
    for (name, value, unit) in &mut cause.parameters {
        let told = match (*name, compliance, delay) {
            ("delay", _, Some(delay)) => ("delay", delay.value, "s"),
            ("twist_per_speed", Some(c), _) => ("coefficient", *value / c.value, "N·m·s/rad"),
            ("twist", Some(c), _) => ("torque", *value / c.value, "N·m"),
            _ => continue,
        };
        (*name, *value, *unit) = told;
    }
}

impl Joint {
    /// The nominal spring under the motor's torque, its zero free; without one the best spring.
    fn simulated(&self) -> Vec<f64> {
        let (torque, twist) = (&self.data.torque, &self.data.twist);
        let slope = match self.nominal.stiffness {
            Some(k) => -1.0 / k,
            None => projection::partial(&[vec![1.0; self.data.rows()]], torque, twist).slope,
        };
        let middle = mean(torque);
        torque.iter().map(|t| slope * (t - middle)).collect()
    }

    /// The pattern that is seen and not named; of meshing teeth with their orders.
    fn seen(&self, answer: &Answer) -> Option<String> {
        let seen = answer
            .is_open()
            .then(|| answer.unexplained.description.clone())?;
        if seen != MESHING {
            return Some(seen);
        }
        let strange = self.waves.iter().filter(|w| !w.of_encoder);
        let order = |order: f64| match self.ratio {
            Some(r) => format!(
                "{order:.0} per turn of the link, {} of the motor",
                significant(order / r, 3)
            ),
            None => format!("{order:.0} per turn of the link"),
        };
        let orders: Vec<String> = strange.map(|w| order(w.order)).collect();
        Some(format!("{seen} ({})", orders.join("; ")))
    }
}
