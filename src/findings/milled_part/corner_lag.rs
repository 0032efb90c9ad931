//! The controller rounds corners: the tool follows an average of the programmed path, over a length of it or over the way just past, its
//! axes lag by a first order, or it blends from farther away than was asked for (source 001, figure 3).

use super::driven::Driven;
use super::tried::left_along;
use super::{Case, Station};
use crate::findings::bent;
use crate::findings::engine::{Blamed, Member};
use crate::findings::table::{Effect, Place};
use crate::ground::spatial::{V3, add, dot, norm, scale, sub};
use crate::ground::stats::{difference, largest};
use crate::process::Way;

pub(super) const EFFECT: Effect<Case> = Effect {
    name: "corner_lag",
    summary: "The controller rounds the corners of the path.",
    mechanism: "controller",
    law_error: 0.0,
    can_be: |_, _| true,
    places: |case| vec![Place::new("controller", members(case))],
    parameters: |_, blamed| match blamed.shape[1] {
        LATE_BY_TIME => vec![("time_constant", blamed.amounts[0], "s")],
        FARTHER_OFF => vec![("blend_farther", blamed.amounts[0], "m")],
        _ => vec![
            ("length", blamed.shape[2], "m"),
            ("share", blamed.amounts[0], "1"),
        ],
    },
    would_tell: "record the joint angles while the path runs",
};

/// Lengths over which a controller may average, ways by which its axes stay behind, m, and time constants of its axes, s.
const LENGTHS: [f64; 6] = [0.5e-3, 1e-3, 2e-3, 4e-3, 8e-3, 16e-3];
const WAYS: [f64; 5] = [0.15e-3, 0.3e-3, 0.6e-3, 1.2e-3, 2.4e-3];
const TIMES: [f64; 9] = [5e-3, 7e-3, 10e-3, 14e-3, 20e-3, 28e-3, 40e-3, 56e-3, 80e-3];
/// How much farther from its corners than asked for it may blend, m.
const FARTHER: [f64; 12] = [
    0.25e-3, 0.5e-3, 0.75e-3, 1e-3, 1.5e-3, 2e-3, 2.5e-3, 3e-3, 4e-3, 6e-3, 8e-3, 12e-3,
];
/// The same, what is ordinary of both.
const USUAL: [f64; 2] = [20e-3, 2e-3];
/// Forms: what is milled with axes that lag, and with larger blends.
const LATE_BY_TIME: f64 = 1.0;
const FARTHER_OFF: f64 = 3.0;
/// A driven path this near to a straight one rounds no corner there, m.
const STRAIGHT: f64 = 1e-8;
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
    let each = |reach: f64, driven: &dyn Fn(&Station, f64) -> V3| -> Vec<V3> {
        let stations = case.stations.iter();
        stations
            .map(|s| aside(s, reach, &|d| driven(s, d)))
            .collect()
    };
    let lengths = LENGTHS.map(|l| member(0.0, l, each(l, &|s, d| averaged(way, s.s_m + d, l))));
    let ways = WAYS.map(|l| {
        let driven = |s: &Station, d: f64| behind(way, s.s_m + d, l);
        member(2.0, l, each(LATE * l, &driven))
    });
    let mut all: Vec<Member> = lengths.into_iter().chain(ways).collect();
    if case.is_short && all.iter().any(|m| largest(&m.columns[0]) > 0.0) {
        all.extend(milled(case, LATE_BY_TIME, USUAL[0], &TIMES));
        all.extend(milled(case, FARTHER_OFF, USUAL[1], &FARTHER));
    }
    all
}

/// What is milled along other ways.
fn milled(case: &Case, form: f64, usual: f64, sizes: &[f64]) -> Vec<Member> {
    let changed = |size: f64| {
        let driven = other_way(case, form, size)?;
        let at = (&case.stations[..], case.support);
        let left = left_along(&case.trial, &driven, at, |_| [0.0; 3]).ok()?;
        Some(difference(&case.seen(&left), &case.still))
    };
    match changed(usual).is_some_and(|column| case.holds_some_of(&column)) {
        true => bent::sized(sizes, usual, &[-1.0, form], changed),
        false => Vec::new(),
    }
}

fn other_way(case: &Case, form: f64, size: f64) -> Option<Driven> {
    match form {
        LATE_BY_TIME => Driven::late(&case.setup.way, size),
        FARTHER_OFF => Driven::blended(&case.planned, size),
        _ => None,
    }
}

/// Whether it was found as the part is milled with it.
pub(super) fn is_milled(blamed: &Blamed) -> bool {
    blamed.effect == EFFECT.name && [LATE_BY_TIME, FARTHER_OFF].contains(&blamed.shape[1])
}

/// The way along which the tool is driven, if this is to blame.
pub(super) fn drives(case: &Case, blamed: &Blamed) -> Option<Driven> {
    let size = blamed.amounts.first()?.max(0.0);
    (is_milled(blamed) && size > 0.0).then(|| other_way(case, blamed.shape[1], size))?
}

/// Time constants after which a lag has forgotten.
const LATE: f64 = 5.0;
/// Places of the driven path that are tried on either side.
const TRIED: usize = 24;

/// From a place of the wall to where the driven path passes it: where the plane across the feed cuts that path, not
/// where it is at the same time, m. `driven`: the path by a way or a time from the station on.
fn aside(s: &Station, reach: f64, driven: &dyn Fn(f64) -> V3) -> V3 {
    let from = |d: f64| sub(driven(d), s.tip);
    let beside = |k: i32| {
        let d = from(0.5 * f64::from(k) * reach);
        norm(sub(d, scale(dot(d, s.feed), s.feed)))
    };
    if (-2..=2).all(|k| beside(k) < STRAIGHT) {
        return [0.0; 3];
    }
    let step = reach / TRIED as f64;
    let mut best: Option<(f64, V3)> = None;
    let mut last = from(-reach);
    for i in 1..=2 * TRIED {
        let next = from(step * i as f64 - reach);
        let [a, b] = [dot(last, s.feed), dot(next, s.feed)];
        if a * b <= 0.0 && a != b {
            let crossing = add(scale(b / (b - a), last), scale(a / (a - b), next));
            let far = norm(crossing);
            if best.is_none_or(|(least, _)| far < least) {
                best = Some((far, crossing));
            }
        }
        last = next;
    }
    best.map_or([0.0; 3], |b| b.1)
}

/// Mean of the path over a length about a place of it, m.
fn averaged(way: &Way, s_m: f64, length: f64) -> V3 {
    let share = |i: usize| (i as f64 + 0.5) / SAMPLES as f64 - 0.5;
    mean((0..SAMPLES).map(|i| (along(way, s_m + length * share(i)), 1.0)))
}

/// The programmed path at an arc length.
fn along(way: &Way, s_m: f64) -> V3 {
    let rows = way.rows();
    let after = rows.partition_point(|row| row.s_m < s_m);
    let [a, b] = [after.saturating_sub(1), after].map(|i| &rows[i.min(rows.len() - 1)]);
    let share = match b.s_m > a.s_m {
        true => ((s_m - a.s_m) / (b.s_m - a.s_m)).clamp(0.0, 1.0),
        false => 1.0,
    };
    add(scale(1.0 - share, a.tip), scale(share, b.tip))
}

/// What axes make of the path at a place of it that stay behind by a way, m.
fn behind(way: &Way, s_m: f64, length: f64) -> V3 {
    let back = |i: usize| LATE * length * (i as f64 + 0.5) / SAMPLES as f64;
    mean((0..SAMPLES).map(|i| (along(way, s_m - back(i)), (-back(i) / length).exp())))
}

fn mean(places: impl Iterator<Item = (V3, f64)>) -> V3 {
    let (sum, weight) = places.fold(([0.0; 3], 0.0), |(sum, weight), (place, w)| {
        (add(sum, scale(w, place)), weight + w)
    });
    scale(1.0 / weight, sum)
}
