//! Lower feeds where joints would be too fast.

use super::cell::Cell;
use super::plan::Row;
use crate::path::profile::Step;

/// Feeds are lowered in steps of this ratio.
const RATIO: f64 = 0.85;
/// Share of a joint's speed that is used.
const USED: f64 = 0.995;

/// How many times faster than allowed the fastest joint moves between two rows.
pub fn excess(cell: &Cell, pair: &[Row], cycle: f64) -> f64 {
    let joints = cell.robot.joints.iter().enumerate();
    let one = |(i, joint): (usize, &crate::robot::Joint)| {
        let speed = (pair[1].q[i] - pair[0].q[i]).abs() / cycle;
        speed / joint.max_speed.unwrap_or(f64::INFINITY)
    };
    joints.map(one).fold(0.0, f64::max)
}

/// Speeds that keep every joint within its limit where `may` allows it, over the arc length from 0
/// to `length` (m); `None` if all is well.
pub fn caps(
    cell: &Cell,
    rows: &[Row],
    cycle: f64,
    length: f64,
    may: impl Fn(f64) -> bool,
) -> Option<Vec<Step>> {
    let mut caps: Vec<Step> = Vec::new();
    let mut found = false;
    let mut at = 0.0;
    for pair in rows.windows(2) {
        let excess = excess(cell, pair, cycle);
        let (from, to) = (pair[0].s.max(at), pair[1].s);
        let gone = pair[1].s - pair[0].s;
        let too_fast = excess > 1.0 && gone > 0.0 && may(0.5 * (pair[0].s + to));
        if !too_fast || to <= from {
            continue;
        }
        let speed = (USED * gone / cycle / excess).ln() / RATIO.ln();
        let speed = RATIO.powf(speed.ceil());
        free(&mut caps, at, from);
        crate::path::profile::append(&mut caps, [from, to], speed);
        at = to;
        found = true;
    }
    free(&mut caps, at, length);
    found.then_some(caps)
}

fn free(caps: &mut Vec<Step>, from: f64, to: f64) {
    crate::path::profile::append(caps, [from, to], f64::INFINITY);
}
