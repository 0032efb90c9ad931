//! From the atoms of a set to causes with a name, a site, parameters and a gain.

use super::case::Case;
use super::columns::Kind;
use super::columns::Kind::Hysteresis;
use super::delay::Delay;
use super::stiffness::Compliance;
use super::unseen::{Split, gain, held_out};
use crate::findings::answer::{Cause, Group};
use crate::findings::gain::Gain;
use crate::fit::parameter::Z95;

/// What is named of a joint.
#[derive(Debug, Clone, Default)]
pub struct Named {
    /// Causes.
    pub causes: Vec<Cause>,
    /// Groups that cannot be separated.
    pub groups: Vec<Group>,
}

/// Effects of this kind of measurement, each with one sentence.
const SUMMARIES: &[(&str, &str)] = &[
    (
        "time_skew",
        "The encoders of motor and link are not read at the same instant.",
    ),
    (
        "backlash",
        "A free gap in the gear: the link is loose while the torque changes sign.",
    ),
    (
        "hysteresis",
        "The gear gives and takes back on different curves.",
    ),
    (
        "coulomb_friction",
        "Dry friction between motor and spring takes torque that never reaches the link.",
    ),
    (
        "viscous_friction",
        "Friction in proportion to the speed takes torque that never reaches the link.",
    ),
    (
        "stiffness",
        "The stiffness that the simulation uses is not the joint's.",
    ),
    (
        "encoder_ripple",
        "An encoder errs periodically over its turn.",
    ),
    ("sensor_offset", "The zero of an encoder is off, or jumps."),
];

/// The sentence about an effect.
pub fn summary(effect: &str) -> &'static str {
    SUMMARIES.iter().find(|s| s.0 == effect).map_or("", |s| s.1)
}

/// The name of a kind where both signs of a rate are meant; silent kinds in words.
pub fn spoken(kind: Kind) -> &'static str {
    match kind {
        Kind::Rate => "rate",
        Kind::Coulomb => "coulomb_friction",
        Kind::Backlash => "backlash",
        Kind::Hysteresis => "hysteresis",
        Kind::Offset => "sensor_offset",
        Kind::Ripple => "encoder_ripple",
        Kind::Mesh => "(meshing)",
        Kind::Position => "(slow over the angle)",
    }
}

/// A declared delay counts as known to within this share of itself.
const DECLARED: f64 = 0.25;
/// What the torque must show of a friction at least, relative to what the twist asks for: its own
/// error and this share of itself are forgiven.
const FRICTION_SHARE: f64 = 0.3;

/// Names everything that was chosen for a joint.
pub(super) fn name(
    case: &Case,
    chosen: &[usize],
    delay: Option<Delay>,
    compliance: Option<Compliance>,
) -> Named {
    let mut named = Named::default();
    for index in chosen.iter().filter(|i| !case.atoms[**i].kind.is_silent()) {
        let gain = case.gain(chosen, *index);
        match (case.atoms[*index].kind, delay) {
            (Kind::Rate, Some(delay)) => name_rate(case, delay, compliance, gain, &mut named),
            (kind, _) => name_other(case, chosen, *index, kind, compliance, gain, &mut named),
        }
    }
    named.causes.extend(stiffness(case, chosen, compliance));
    named.causes.extend(zero(case));
    named
}

fn name_rate(
    case: &Case,
    delay: Delay,
    compliance: Option<Compliance>,
    gain: Gain,
    named: &mut Named,
) {
    let declared = case.record.delay.unwrap_or(0.0).abs();
    if declared > 0.0 && delay.value.abs() < (DECLARED * declared).max(Z95 * delay.std) {
        return;
    }
    let skew = vec![("delay", delay.value + case.record.delay.unwrap_or(0.0), "s")];
    let viscous = match compliance {
        Some(c) => vec![("coefficient", delay.rate / c.value, "N·m·s/rad")],
        None => vec![("twist_per_speed", delay.rate, "s")],
    };
    let one = |effect, parameters| cause(case, effect, parameters, gain);
    let [shown, error] = delay.friction;
    let forgiven = (2.0 * error).max(FRICTION_SHARE * delay.rate);
    let is_friction = (shown - delay.rate).abs() < forgiven;
    let is_none = shown.abs() < forgiven;
    match (delay.rate > 0.0, is_friction, is_none) {
        (true, true, false) => named.causes.push(one("viscous_friction", viscous)),
        (false, ..) | (true, false, true) => named.causes.push(one("time_skew", skew)),
        _ => {
            let effects = vec!["viscous_friction", "time_skew"];
            named
                .groups
                .push(case.group(effects, (Kind::Rate, Kind::Rate), gain));
        }
    }
}

fn cause(
    case: &Case,
    effect: &'static str,
    parameters: Vec<(&'static str, f64, &'static str)>,
    gain: Gain,
) -> Cause {
    Cause {
        effect,
        site: case.record.site(),
        probability: gain.probability().min(0.999),
        summary: summary(effect),
        alternatives: Vec::new(),
        parameters,
        gain,
    }
}

fn name_other(
    case: &Case,
    chosen: &[usize],
    index: usize,
    kind: Kind,
    compliance: Option<Compliance>,
    gain: Gain,
    named: &mut Named,
) {
    let rivals = case.stand_ins(chosen, index);
    let spoken_rivals = rivals.iter().filter(|r| !r.0.is_silent());
    if let Some((rival, _)) = spoken_rivals.clone().next() {
        let mut effects = vec![spoken(kind)];
        effects.extend(spoken_rivals.map(|r| match r.0 {
            Kind::Rate => "time_skew",
            other => spoken(other),
        }));
        named.groups.push(case.group(effects, (kind, *rival), gain));
        return;
    }
    let a = case.amplitudes_of(chosen, index);
    let shape = case.atoms[index].shape;
    let parameters = match kind {
        Kind::Backlash => vec![("gap", 2.0 * a[0], "rad")],
        Kind::Coulomb => match compliance {
            Some(c) => vec![("torque", a[0] / c.value, "N·m")],
            None => vec![("twist", a[0], "rad")],
        },
        Kind::Ripple => vec![
            ("amplitude", a[0].hypot(a[1]), "rad"),
            ("per_turn_of_the_link", shape, "1"),
        ],
        Kind::Offset => vec![
            ("jump", a[0], "rad"),
            ("instant", case.data.time[shape as usize], "s"),
        ],
        _ => vec![("width", 2.0 * a[0], "rad")],
    };
    named
        .causes
        .push(cause(case, spoken(kind), parameters, gain));
}

/// The stiffness, where the data fix it and it is not the one the simulation uses.
fn stiffness(case: &Case, chosen: &[usize], compliance: Option<Compliance>) -> Option<Cause> {
    let (nominal, found) = (case.nominal.stiffness?, compliance?);
    if chosen.iter().any(|i| case.atoms[*i].kind == Hysteresis) {
        return None; // a loop has no one stiffness
    }
    let log = (1.0 / (found.value * nominal)).ln();
    let std = (found.std / found.value).hypot(case.nominal.rel_std);
    if log.abs() < Z95 * std {
        return None;
    }
    let after = held_out(&case.columns(chosen), &case.data, Split::Long);
    let excess = 1.0 / nominal - found.value;
    let middle = super::channels::mean(&case.data.torque);
    let before: Vec<f64> = after
        .iter()
        .zip(&case.data.torque)
        .map(|(a, t)| a + excess * (t - middle))
        .collect();
    let gain = gain(&before, &after, Split::Long);
    let k = 1.0 / found.value;
    gain.is_real()
        .then(|| cause(case, "stiffness", vec![("stiffness", k, "N·m/rad")], gain))
}

/// A constant difference of the encoders, where the file says how well their zeros agree.
fn zero(case: &Case) -> Option<Cause> {
    let std = case.record.zero_std?;
    let torque = super::channels::mean(&case.data.torque);
    let sag = case.nominal.stiffness.map_or(0.0, |k| -torque / k);
    let offset = case.data.zero - sag;
    if offset.abs() < 3.0 * std.hypot(0.3 * sag) {
        return None;
    }
    let noise = case.noise.colour.rms;
    let gain = Gain::of(offset.hypot(noise), std.hypot(noise), std / offset.abs());
    gain.is_real()
        .then(|| cause(case, "sensor_offset", vec![("offset", offset, "rad")], gain))
}
