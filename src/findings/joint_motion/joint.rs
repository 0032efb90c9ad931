//! The diagnosis of one joint: from its record to what is named and what is left.

use super::case::{Case, all, simulated};
use super::channels::Channels;
use super::columns::{Atom, Kind, base};
use super::delay::{Delay, delay};
use super::description;
use super::named::{self, Named};
use super::noise::{orthonormal, without};
use super::stiffness::{Compliance, compliance};
use super::unseen::{amplitudes, residual};
use crate::findings::answer::Candidate;
use crate::findings::engine::{Found, Judgement, diagnose};
use crate::inference::stats::rms;
use crate::measurement::joint_motion::JointRecord;

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
    /// Noise of one reading, rad.
    pub noise_rms: f64,
    /// The noise in words.
    pub noise: String,
    /// Share of the discrepancy's variance that is left.
    pub share_left: f64,
    /// Probability that chance leaves so much.
    pub p_value: f64,
    /// Whether structure is left that matters.
    pub is_left: bool,
    /// Where the discrepancy is largest.
    pub place: String,
    /// What is left, in words.
    pub description: Option<String>,
}

/// Structure matters above this share of the twist that was measured, rms: the encoders are read to see
/// the twist, and a model that is right to a tenth of it is used.
const MATTERS: f64 = 0.1;

impl JointFinding {
    /// What the named causes leave of the twist, rad.
    pub fn residual(&self) -> Vec<f64> {
        difference(&self.data.twist, &self.explained)
    }

    /// What the present simulation misses, rad.
    pub fn missed(&self) -> Vec<f64> {
        difference(&self.data.twist, &self.simulated)
    }
}

fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

/// Diagnoses one joint.
pub fn diagnose_joint(record: &JointRecord, nominal: Nominal) -> JointFinding {
    let case = Case::new(record, nominal);
    let found = diagnose(&case, &Judgement::default());
    let chosen: Vec<Atom> = found.blamed.iter().map(|b| case.atom(b)).collect();
    let compliance = compliance_of(&case, &chosen);
    let delay = delay_of(&case, &chosen);
    let named = named::name(&case, &found, &chosen, delay, compliance.ok());
    conclude(case, found, &chosen, (named, delay, compliance))
}

fn compliance_of(case: &Case, chosen: &[Atom]) -> Result<Compliance, &'static str> {
    if case.record.ratio.is_none() {
        return Err("the file states no gear ratio");
    }
    let chosen: Vec<&Atom> = chosen.iter().collect();
    compliance(
        &case.data,
        &case.noise,
        &chosen,
        structure(case, &chosen),
        &case.atoms,
    )
}

fn delay_of(case: &Case, chosen: &[Atom]) -> Option<Delay> {
    let has_rate = chosen.iter().any(|a| a.kind == Kind::Rate);
    let chosen: Vec<&Atom> = chosen.iter().collect();
    let asked = has_rate || case.record.delay.is_some();
    asked.then(|| delay(&case.data, &case.noise, &chosen, &case.atoms, case.friction))
}

/// Nats that slow structure over the angle would gain beside the chosen causes.
fn structure(case: &Case, chosen: &[&Atom]) -> f64 {
    let white = |c: &Vec<f64>| case.noise.whiten(c);
    let known = chosen.iter().filter(|a| a.kind != Kind::Position);
    let known = base(&case.data)
        .into_iter()
        .chain(known.flat_map(|a| a.columns.clone()));
    let basis = orthonormal(known.map(|c| white(&c)).collect());
    let left = without(&basis, white(&case.data.twist));
    let slow = case.atoms.iter().filter(|a| a.kind == Kind::Position);
    let own = slow.flat_map(|a| a.columns.iter().map(|c| without(&basis, white(c))));
    let own = orthonormal(own.collect());
    own.iter().map(|c| 0.5 * c.dot(&left).powi(2)).sum()
}

fn conclude(
    case: Case,
    found: Found,
    chosen: &[Atom],
    (named, delay, compliance): (Named, Option<Delay>, Result<Compliance, &'static str>),
) -> JointFinding {
    let data = &case.data;
    let left = left_beside(data, chosen);
    let simulated = simulated(data, case.nominal);
    let missed = difference(&data.twist, &simulated);
    let noise_rms = case.noise.colour.rms.min(rms(&left));
    let structure = rms(&left).powi(2) - noise_rms * noise_rms;
    let share_left = (structure / rms(&missed).powi(2).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    let silent = chosen.iter().any(|a| a.kind.is_silent());
    let matters = structure.max(0.0).sqrt() > MATTERS * rms(&data.twist);
    JointFinding {
        site: case.record.site(),
        place: found.answer.discrepancy.place.clone(),
        description: describe(&case, chosen),
        is_left: (silent || found.answer.p_value < P_LEFT) && matters,
        candidates: found.answer.candidates,
        noise: case.noise.colour.describe(),
        declared: case.record.delay,
        explained: difference(&data.twist, &left),
        simulated,
        named,
        delay,
        compliance,
        noise_rms,
        share_left,
        p_value: found.answer.p_value,
        data: case.data,
    }
}

/// Chance leaves structure less often than this where it counts.
const P_LEFT: f64 = 1e-4;

/// What zero, torque, inertia and the causes with a name leave.
fn left_beside(data: &Channels, chosen: &[Atom]) -> Vec<f64> {
    let loud = chosen.iter().filter(|a| !a.kind.is_silent());
    let columns: Vec<Vec<f64>> = base(data)
        .into_iter()
        .chain(loud.flat_map(|a| a.columns.clone()))
        .collect();
    let columns: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
    let a = amplitudes(&columns, &data.twist, &all(data));
    residual(&columns, &a, &data.twist)
}

/// The silent terms with their rms, in words.
fn describe(case: &Case, chosen: &[Atom]) -> Option<String> {
    let data = &case.data;
    let columns: Vec<Vec<f64>> = base(data)
        .into_iter()
        .chain(chosen.iter().flat_map(|a| a.columns.clone()))
        .collect();
    let slices: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
    let a = amplitudes(&slices, &data.twist, &all(data));
    let mut at = 3;
    let mut sized = Vec::new();
    for atom in chosen {
        let own = at..at + atom.columns.len();
        at = own.end;
        let part: Vec<f64> = (0..data.rows())
            .map(|i| own.clone().map(|k| a[k] * columns[k][i]).sum())
            .collect();
        let mean = super::channels::mean(&part);
        let size = rms(&part.iter().map(|v| v - mean).collect::<Vec<f64>>());
        sized.extend(atom.kind.is_silent().then_some((atom, size)));
    }
    description::left(&sized, case.record.ratio)
}
