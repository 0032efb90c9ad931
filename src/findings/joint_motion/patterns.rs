//! What no cause of the library makes. These compete with the causes and are never named: where one of them is
//! at work, this is what is seen.

use super::channels::range;
use super::encoder_ripple::members;
use super::joint::Joint;
use super::projection::{orthonormal, without};
use crate::findings::engine::Member;
use crate::findings::table::{Pattern, flexible, unit_range, waves};
use nalgebra::DVector;

/// What is seen of meshing teeth.
pub(super) const MESHING: &str = "a ripple in step with the joint that is no encoder's own order or not steady over the speed, as meshing teeth make it";

/// What is seen of a spring that is not straight.
pub(super) const BENT: &str = "a twist that bends with the torque";

/// What is seen of a joint that works loose, or of a torque whose scale drifts.
const CHANGED: &str = "a twist per torque that changes with time, at once or steadily, as a spring that works loose or a torque constant that warms makes it";

/// All of them; the first of a set is told.
pub(super) const PATTERNS: &[Pattern<Joint>] = &[
    Pattern {
        name: "load",
        summary: BENT,
        members: |joint| bends(&joint.geared),
    },
    Pattern {
        name: "meshing",
        summary: MESHING,
        members: |joint| members(joint, false),
    },
    Pattern {
        name: "late",
        summary: "a twist that follows the torque late, as what creeps does",
        members: |joint| flexible(LATE_S.map(|late| creeping(joint, late)).to_vec()),
    },
    Pattern {
        name: "angle",
        summary: "a slow change over the joint angle",
        members: |joint| over(&joint.data.motor, 4),
    },
    Pattern {
        name: "drift",
        summary: "a slow change with time",
        members: |joint| over(&joint.data.time, 3),
    },
    Pattern {
        name: "changed",
        summary: CHANGED,
        members: changed,
    },
    Pattern {
        name: "speed",
        summary: "a twist that bends with the speed",
        members: |joint| bends(&joint.data.speed),
    },
];

/// Parts of the record at whose ends a spring may change: an instant that is a forty-eighth of it off is wrong there alone. A
/// choice, no measurement.
const PARTS: usize = 24;

/// The torque from an instant on, or ever more of it: a jump of an encoder leaves the slope of the twist over it as it was, a spring that
/// changes does not.
fn changed(joint: &Joint) -> Vec<Member> {
    let n = joint.data.rows();
    let progress = unit_range(&joint.data.time);
    let ever_more = joint.column(|i| progress[i] * joint.geared[i]);
    let from = |row: usize| {
        let after = |i: usize| if i < row { 0.0 } else { joint.geared[i] };
        Member::free(joint.column(after))
    };
    let even = (1..PARTS).map(|part| n * part / PARTS);
    even.map(from).chain([Member::free(ever_more)]).collect()
}

/// Time constants of what creeps, s.
const LATE_S: [f64; 3] = [0.1, 0.3, 0.9];

/// What the torque's recent past adds to the twist beyond the torque itself.
fn creeping(joint: &Joint, late: f64) -> Vec<f64> {
    let past = lagging(&joint.data.time, &joint.geared, late);
    joint.column(|i| past[i] - joint.geared[i])
}

/// What follows values with a time constant, s.
pub(super) fn lagging(time: &[f64], values: &[f64], late: f64) -> Vec<f64> {
    let mut at = values[0];
    let of = |i: usize| {
        let step = time[i] - time[i.saturating_sub(1)];
        at += (values[i] - at) * (1.0 - (-step / late).exp());
        at
    };
    (0..time.len()).map(of).collect()
}

/// Waves of a curve over torque or speed.
const WAVES: usize = 5;

/// Any smooth function of a channel that moves, as slow as these waves.
fn over(channel: &[f64], count: usize) -> Vec<Member> {
    match range(channel) {
        (low, high) if high > low => flexible(waves(&unit_range(channel), count)),
        _ => Vec::new(),
    }
}

/// The same without a straight line, which is a spring, or a delay.
fn bends(channel: &[f64]) -> Vec<Member> {
    let straight = orthonormal(&[vec![1.0; channel.len()], channel.to_vec()]);
    let bent = |wave: &Vec<f64>| {
        let left = without(&straight, DVector::from_column_slice(wave));
        left.as_slice().to_vec()
    };
    let mut members = over(channel, WAVES);
    for member in &mut members {
        member.columns = member.columns.iter().map(bent).collect();
    }
    members
}
