//! From the atoms of a set to causes with a name, a site, parameters and a gain.

use super::case::Case;
use super::columns::{Atom, Kind, base};
use super::delay::Delay;
use super::next;
use super::stiffness::Compliance;
use super::unseen::{Split, held_out};
use crate::findings::answer::{Cause, Group};
use crate::findings::engine::Found;
use crate::findings::engine::unseen::compare;
use crate::findings::gain::Gain;
use crate::inference::stats::Z95;

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

/// A declared delay counts as known to within this share of itself.
const DECLARED: f64 = 0.25;
/// What the torque must show of a friction at least, relative to what the twist asks for: its own
/// error and this share of itself are forgiven.
const FRICTION_SHARE: f64 = 0.3;

/// Names everything that the engine chose for a joint.
pub(super) fn name(
    case: &Case,
    found: &Found,
    chosen: &[Atom],
    delay: Option<Delay>,
    compliance: Option<Compliance>,
) -> Named {
    let mut named = Named::default();
    for one in &found.answer.causes {
        name_one(
            case,
            (one.effect, one.gain, one.probability),
            (found, chosen),
            delay,
            compliance,
            &mut named,
        );
    }
    for group in &found.answer.groups {
        name_group(case, group, (found, chosen), delay, compliance, &mut named);
    }
    named.causes.extend(stiffness(case, chosen, compliance));
    named.causes.extend(zero(case));
    named
}

/// A group less its silent members; one that is left alone is a cause.
fn name_group(
    case: &Case,
    group: &Group,
    of: (&Found, &[Atom]),
    delay: Option<Delay>,
    compliance: Option<Compliance>,
    named: &mut Named,
) {
    let is_spoken = |e: &&&'static str| Kind::named(e).is_some_and(|k| !k.is_silent());
    let spoken: Vec<&'static str> = group.effects.iter().filter(is_spoken).copied().collect();
    match spoken[..] {
        [] => {}
        [one] if one == group.effects[0] => {
            name_one(case, (one, group.gain, 0.5), of, delay, compliance, named);
        }
        [_] => {}
        _ => named.groups.push(Group {
            effects: spoken
                .iter()
                .map(|e| if *e == "rate" { "time_skew" } else { e })
                .collect(),
            sites: vec![case.record.site(); spoken.len()],
            ..group.clone()
        }),
    }
}

fn name_one(
    case: &Case,
    (effect, gain, probability): (&'static str, Gain, f64),
    (found, chosen): (&Found, &[Atom]),
    delay: Option<Delay>,
    compliance: Option<Compliance>,
    named: &mut Named,
) {
    let Some(at) = found.blamed.iter().position(|b| b.effect == effect) else {
        return;
    };
    match (chosen[at].kind, delay) {
        (kind, _) if kind.is_silent() => {}
        (Kind::Rate, Some(delay)) => name_rate(case, delay, compliance, (gain, probability), named),
        _ => {
            let parameters = parameters(case, &chosen[at], &found.blamed[at].amounts, compliance);
            named
                .causes
                .push(cause(case, effect, parameters, (gain, probability)));
        }
    }
}

fn name_rate(
    case: &Case,
    delay: Delay,
    compliance: Option<Compliance>,
    (gain, probability): (Gain, f64),
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
    let one = |effect, parameters| cause(case, effect, parameters, (gain, probability));
    let [shown, error] = delay.friction;
    let forgiven = (2.0 * error).max(FRICTION_SHARE * delay.rate);
    let is_friction = (shown - delay.rate).abs() < forgiven;
    let is_none = shown.abs() < forgiven;
    match (delay.rate > 0.0, is_friction, is_none) {
        (true, true, false) => named.causes.push(one("viscous_friction", viscous)),
        (false, ..) | (true, false, true) => named.causes.push(one("time_skew", skew)),
        _ => {
            let effects = vec!["viscous_friction", "time_skew"];
            named.groups.push(Group {
                sites: vec![case.record.site(); effects.len()],
                effects,
                would_tell: next::would_tell(Kind::Rate, Kind::Rate).into(),
                gain,
            });
        }
    }
}

fn cause(
    case: &Case,
    effect: &'static str,
    parameters: Vec<(&'static str, f64, &'static str)>,
    (gain, probability): (Gain, f64),
) -> Cause {
    Cause {
        effect,
        site: case.record.site(),
        probability,
        summary: summary(effect),
        alternatives: Vec::new(),
        parameters,
        gain,
    }
}

fn parameters(
    case: &Case,
    atom: &Atom,
    a: &[f64],
    compliance: Option<Compliance>,
) -> Vec<(&'static str, f64, &'static str)> {
    match atom.kind {
        Kind::Backlash => vec![("gap", 2.0 * a[0], "rad")],
        Kind::Coulomb => match compliance {
            Some(c) => vec![("torque", a[0] / c.value, "N·m")],
            None => vec![("twist", a[0], "rad")],
        },
        Kind::Ripple => vec![
            ("amplitude", a[0].hypot(a[1]), "rad"),
            ("per_turn_of_the_link", atom.shape, "1"),
        ],
        Kind::Offset => vec![
            ("jump", a[0], "rad"),
            ("instant", case.data.time[atom.shape as usize], "s"),
        ],
        _ => vec![("width", 2.0 * a[0], "rad")],
    }
}

/// The stiffness, where the data fix it and it is not the one the simulation uses.
fn stiffness(case: &Case, chosen: &[Atom], compliance: Option<Compliance>) -> Option<Cause> {
    let (nominal, found) = (case.nominal.stiffness?, compliance?);
    if chosen.iter().any(|a| a.kind == Kind::Hysteresis) {
        return None; // a loop has no one stiffness
    }
    let log = (1.0 / (found.value * nominal)).ln();
    let std = (found.std / found.value).hypot(case.nominal.rel_std);
    if log.abs() < Z95 * std {
        return None;
    }
    let columns: Vec<Vec<f64>> = base(&case.data)
        .into_iter()
        .chain(chosen.iter().flat_map(|a| a.columns.clone()))
        .collect();
    let columns: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
    let after = held_out(&columns, &case.data, Split::Long);
    let excess = 1.0 / nominal - found.value;
    let middle = super::channels::mean(&case.data.torque);
    let before: Vec<f64> = after
        .iter()
        .zip(&case.data.torque)
        .map(|(a, t)| a + excess * (t - middle))
        .collect();
    let rows = case.data.rows();
    let folds: Vec<usize> = (0..rows).map(|i| Split::Long.fold(i, rows)).collect();
    let gain = compare(&before, &after, &folds);
    let k = 1.0 / found.value;
    let sure = (gain, gain.probability().min(0.999));
    gain.is_real()
        .then(|| cause(case, "stiffness", vec![("stiffness", k, "N·m/rad")], sure))
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
    let sure = (gain, gain.probability().min(0.999));
    gain.is_real()
        .then(|| cause(case, "sensor_offset", vec![("offset", offset, "rad")], sure))
}
