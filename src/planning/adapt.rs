//! Lower feeds where joints would be too fast, or would have to accelerate too hard.

use super::cell::{Cell, JOINTS};
use super::plan::Row;
use crate::path::profile::Step;

/// Feeds are lowered in steps of this ratio.
const RATIO: f64 = 0.85;
/// Share of a joint's limit that is used.
const USED: f64 = 0.995;
/// Share of a joint's acceleration that speeding up along the path may take, where it is too much
/// together with the bends of the path.
const ALONG: f64 = 0.5;

/// What rows ask of joints beyond their limits.
pub struct Demand {
    /// The feed between two rows must be divided by this; up to 1 all is well.
    pub feed: Vec<f64>,
    /// The acceleration along the path must be divided by this.
    pub ease: f64,
}

/// Speed of a joint between two rows, rad/s.
pub fn speed(pair: &[Row], joint: usize, cycle: f64) -> f64 {
    (pair[1].q[joint] - pair[0].q[joint]).abs() / cycle
}

/// Acceleration of a joint at the middle of three rows, rad/s².
pub fn acceleration(rows: &[Row], joint: usize, cycle: f64) -> f64 {
    let q = [0, 1, 2].map(|k: usize| rows[k].q[joint]);
    (q[0] - 2.0 * q[1] + q[2]) / (cycle * cycle)
}

/// How many times slower rows would have to be for every joint to keep its limits.
pub fn excess(cell: &Cell, rows: &[Row], cycle: f64) -> f64 {
    let (speeds, hardest) = limits(cell);
    let fast = rows.windows(2).map(|pair| too_fast(&speeds, pair, cycle));
    let hard = (0..JOINTS).flat_map(|i| {
        let limit = hardest[i];
        let share = move |three: &[Row]| acceleration(three, i, cycle).abs() / limit;
        rows.windows(3).map(share)
    });
    fast.chain(hard.map(f64::sqrt)).fold(0.0, f64::max)
}

/// The demand of rows over their joints' limits.
pub fn demand(cell: &Cell, rows: &[Row], cycle: f64) -> Demand {
    let (speeds, hardest) = limits(cell);
    let pairs = rows.windows(2);
    let mut demand = Demand {
        feed: pairs.map(|pair| too_fast(&speeds, pair, cycle)).collect(),
        ease: 1.0,
    };
    let limited = (0..JOINTS).filter(|i| hardest[*i].is_finite());
    for i in limited {
        for (k, three) in rows.windows(3).enumerate() {
            let all = acceleration(three, i, cycle) / hardest[i];
            if all.abs() > 1.0 {
                demand.add(k, all, along(three, i, cycle) / hardest[i]);
            }
        }
    }
    demand
}

impl Demand {
    /// Rows `k` to `k + 2` take `all` of a joint's acceleration, of it `along` by speeding up: the rest
    /// goes with the square of the feed.
    fn add(&mut self, k: usize, all: f64, along: f64) {
        let bend = (all - along).abs() / (1.0 - along.abs().min(ALONG));
        self.ease = self.ease.max(along.abs() / ALONG);
        for feed in &mut self.feed[k..k + 2] {
            *feed = feed.max(bend.sqrt());
        }
    }
}

/// The part of a joint's acceleration that speeding up or slowing down along the path makes, rad/s².
fn along(three: &[Row], joint: usize, cycle: f64) -> f64 {
    let gone = three[2].s - three[0].s;
    if gone <= 0.0 {
        return 0.0;
    }
    let slope = (three[2].q[joint] - three[0].q[joint]) / gone;
    slope * (three[0].s - 2.0 * three[1].s + three[2].s) / (cycle * cycle)
}

/// Highest speeds (rad/s) and accelerations (rad/s²) of the joints.
fn limits(cell: &Cell) -> ([f64; JOINTS], [f64; JOINTS]) {
    let of = |i: usize| &cell.robot.joints[i];
    let speeds = std::array::from_fn(|i| of(i).max_speed.unwrap_or(f64::INFINITY));
    let hardest = std::array::from_fn(|i| of(i).max_acceleration.unwrap_or(f64::INFINITY));
    (speeds, hardest)
}

/// How many times faster than allowed the fastest joint moves between two rows.
fn too_fast(speeds: &[f64; JOINTS], pair: &[Row], cycle: f64) -> f64 {
    let joints = speeds.iter().enumerate();
    let shares = joints.map(|(i, limit)| speed(pair, i, cycle) / limit);
    shares.fold(0.0, f64::max)
}

/// Speeds that meet the demand where `may` allows it, over the arc length from 0 to `length` (m); `None`
/// if all is well.
pub fn caps(
    demand: &Demand,
    rows: &[Row],
    cycle: f64,
    length: f64,
    may: impl Fn(f64) -> bool,
) -> Option<Vec<Step>> {
    let mut caps: Vec<Step> = Vec::new();
    let mut found = false;
    let mut at = 0.0;
    for (pair, excess) in rows.windows(2).zip(&demand.feed) {
        let (from, to) = (pair[0].s.max(at), pair[1].s);
        let gone = pair[1].s - pair[0].s;
        let too_much = *excess > 1.0 && gone > 0.0 && may(0.5 * (pair[0].s + to));
        if !too_much || to <= from {
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
