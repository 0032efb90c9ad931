//! A free gap in the gear: the twist jumps where the torque changes sign.

use super::balanced;
use super::channels::largest;
use super::coulomb_friction::AT_REST;
use super::joint::Joint;
use super::patterns::lagging;
use crate::findings::engine::{Blamed, Member, Nuisance};
use crate::findings::table::{Effect, Place};
use crate::signal::play::play;

/// Shares of the largest torque over which a gap closes.
const WIDTHS: [f64; 9] = [0.003, 0.005, 0.008, 0.013, 0.02, 0.032, 0.05, 0.08, 0.15];
/// Shares of the largest torque that hold a link where it is while it is loose.
const HELD: [f64; 3] = [0.02, 0.05, 0.1];
/// Times in which the link crosses the gap, s, and shares of the largest torque over which it then closes: from the start that the
/// motor gives it or its own weight, it takes tens of milliseconds.
const CROSSED_S: [f64; 3] = [0.01, 0.02, 0.04];
const CLOSES: [f64; 3] = [0.003, 0.01, 0.03];
/// Share of the largest torque below which a link is loose; how long a rest lasts at least, s: three times what the channels are smoothed
/// over; and of how many, the longest, nobody knows where the link lay. Choices.
const LOOSE: f64 = 0.05;
const LASTING_S: f64 = 0.1;
const RESTS: usize = 24;
/// Share of a gap whose flanks are those of another form. A choice.
const MISSED: f64 = 0.3;
/// Share of the largest torque that must be passed to either side, and of the readings in which it must be: a gap shows
/// where the torque passes zero, however briefly.
const BOTH_WAYS: f64 = 0.02;
const SELDOM: f64 = 0.01;

/// As the engine takes it: one amount is half the gap, rad.
pub(super) const EFFECT: Effect<Joint> = Effect {
    name: "backlash",
    summary: "A free gap in the gear: the link is loose while the torque changes sign.",
    mechanism: "contact",
    // contacts bounce
    law_error: 0.1,
    can_be: |_, _| true,
    places: |joint| {
        let torques = torques(joint);
        let scale = largest(&joint.geared);
        let both = torques.iter().enumerate();
        let both = both.filter(|(_, t)| balanced(t, BOTH_WAYS * scale, SELDOM));
        let members = both.flat_map(|(k, t)| {
            let columns = forms(joint, t, scale).into_iter();
            columns.map(move |c| Member::free(c).positive().shaped(&[k as f64]))
        });
        vec![Place::new(&joint.site, members.collect())]
    },
    parameters: |_, blamed| vec![("gap", 2.0 * blamed.amounts[0], "rad")],
    would_tell: "let the torque pass zero slowly, once with and once without reversing the motion: a gap follows the sign of the torque, friction that of the speed",
};

/// The torque in the gear, and the same with friction on the other side of the gap.
fn torques(joint: &Joint) -> [Vec<f64>; 2] {
    let (data, friction) = (&joint.data, joint.friction);
    let other = match joint.presumed {
        // the one in the gear is without it already
        Some(_) => friction.with(data, &joint.geared),
        None => friction.less(data, &joint.geared),
    };
    [joint.geared.clone(), other]
}

/// Twist by a gap under a torque, in every form.
fn forms(joint: &Joint, torque: &[f64], scale: f64) -> Vec<Vec<f64>> {
    let held = HELD.map(|h| step(&play(torque, h * scale), WIDTHS[0]));
    let steps = WIDTHS
        .iter()
        .flat_map(|w| [step(torque, *w), soft(torque, *w)]);
    let crossed = CROSSED_S
        .iter()
        .flat_map(|late| CLOSES.map(|w| lagging(&joint.data.time, &step(torque, w), *late)));
    steps.chain(held).chain(crossed).collect()
}

/// Every rest under hardly any torque, one where it lasts: the link lies anywhere in the gap.
pub(super) fn rests(joint: &Joint) -> Vec<Vec<f64>> {
    let (still, loose) = (
        AT_REST * joint.data.top_speed(),
        LOOSE * largest(&joint.geared),
    );
    let rests = |i: &usize| joint.data.speed[*i].abs() < still && joint.geared[*i].abs() < loose;
    let rows: Vec<usize> = (0..joint.data.rows()).filter(rests).collect();
    let time = &joint.data.time;
    let lasts = |run: &[usize]| time[run[run.len() - 1]] - time[run[0]];
    let mut lasting: Vec<&[usize]> = rows.chunk_by(|a, b| b - a == 1).collect();
    lasting.retain(|run| lasts(run) >= LASTING_S);
    lasting.sort_by(|a, b| lasts(b).total_cmp(&lasts(a)));
    let one = |run: &[usize]| {
        let (first, last) = (run[0], run[run.len() - 1]);
        joint.column(|i| f64::from(u8::from((first..=last).contains(&i))))
    };
    lasting.into_iter().take(RESTS).map(one).collect()
}

/// What the law that was found of a gap misses where it opens and closes: flanks that meet sooner or later, or over more torque.
pub(super) fn flanks(joint: &Joint, blamed: &Blamed) -> Vec<Nuisance> {
    let half = blamed.amounts[0].abs();
    let torques = torques(joint);
    let torque = &torques[blamed.shape.first().map_or(0, |k| *k as usize)];
    let wide = [WIDTHS[0], WIDTHS[5]].map(|w| step(torque, w));
    let late = CROSSED_S.map(|late| lagging(&joint.data.time, &step(torque, CLOSES[1]), late));
    let other = |column: Vec<f64>| {
        let each = column.iter().zip(&blamed.part);
        Nuisance {
            column: each.map(|(c, part)| half * c - part).collect(),
            spread: MISSED,
        }
    };
    wide.into_iter().chain(late).map(other).collect()
}

/// Twist by a gap that closes over this share of the largest torque.
pub(super) fn step(torque: &[f64], width: f64) -> Vec<f64> {
    let closes = (width * largest(torque)).max(f64::MIN_POSITIVE);
    torque.iter().map(|t| -(t / closes).tanh()).collect()
}

/// Twist by a gap whose flanks come into contact one after the other.
fn soft(torque: &[f64], width: f64) -> Vec<f64> {
    let closes = (width * largest(torque)).max(f64::MIN_POSITIVE);
    let of = |t: &f64| -(t / closes).atan() * std::f64::consts::FRAC_2_PI;
    torque.iter().map(of).collect()
}
