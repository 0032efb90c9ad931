//! The controller rounds corners: the tool follows an average of the programmed path, over a length of it or
//! over the time just past (source 001, figure 3).

use super::Case;
use crate::findings::engine::Member;
use crate::findings::table::{Effect, Place};
use crate::ground::spatial::{V3, add, scale, sub};
use crate::process::Way;

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "corner_lag",
    summary: "The controller rounds the corners of the path.",
    mechanism: "controller",
    places: |case| vec![Place::new("controller", members(case))],
    parameters: |_, blamed| {
        let unit = if blamed.shape[1] == 0.0 { "m" } else { "s" };
        let name = if blamed.shape[1] == 0.0 {
            "length"
        } else {
            "time_constant"
        };
        vec![
            (name, blamed.shape[2], unit),
            ("share", blamed.amounts[0], "1"),
        ]
    },
    would_tell: "record the joint angles while the path runs",
};

/// Lengths over which a controller may average, m, and its time constants, s.
const LENGTHS: [f64; 6] = [0.5e-3, 1e-3, 2e-3, 4e-3, 8e-3, 16e-3];
const TIMES: [f64; 5] = [5e-3, 10e-3, 20e-3, 40e-3, 80e-3];
/// Samples of an average.
const SAMPLES: usize = 40;
/// How far the share may be from one.
const ORDINARY: f64 = 1.0;

fn members(case: &Case) -> Vec<Member> {
    let way = &case.setup.way;
    let member = |form: f64, size: f64, moved: Vec<V3>| {
        Member::given(case.seen(&moved), ORDINARY)
            .positive()
            .shaped(&[-1.0, form, size])
    };
    let at = |of: &dyn Fn(f64) -> V3| case.stations.iter().map(|s| of(s.time_s)).collect();
    let lengths = LENGTHS.map(|l| member(0.0, l, at(&|t| averaged(way, t, l))));
    let times = TIMES.map(|tau| member(1.0, tau, at(&|t| late(way, t, tau))));
    lengths.into_iter().chain(times).collect()
}

/// Mean of the path over a length about a time, less the path there, m.
fn averaged(way: &Way, time: f64, length: f64) -> V3 {
    let tip = way.at(time).tip;
    let speed = speed(way, time).max(1e-4);
    let window = length / speed;
    let share = |i: usize| (i as f64 + 0.5) / SAMPLES as f64 - 0.5;
    mean(
        (0..SAMPLES).map(|i| (way.at(time + window * share(i)).tip, 1.0)),
        tip,
    )
}

/// What a first-order lag makes of the path at a time, less the path there, m.
fn late(way: &Way, time: f64, tau: f64) -> V3 {
    let tip = way.at(time).tip;
    let back = |i: usize| 5.0 * tau * (i as f64 + 0.5) / SAMPLES as f64;
    let weighed = (0..SAMPLES).map(|i| (way.at(time - back(i)).tip, (-back(i) / tau).exp()));
    mean(weighed, tip)
}

fn mean(places: impl Iterator<Item = (V3, f64)>, about: V3) -> V3 {
    let (sum, weight) = places.fold(([0.0; 3], 0.0), |(sum, weight), (place, w)| {
        (add(sum, scale(w, sub(place, about))), weight + w)
    });
    scale(1.0 / weight, sum)
}

fn speed(way: &Way, time: f64) -> f64 {
    let [a, b] = [-1e-3, 1e-3].map(|d| way.at(time + d));
    (b.s_m - a.s_m) / 2e-3
}
