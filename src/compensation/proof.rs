//! The proof that a corrected path stays within its limits: a list of what was checked, each with the
//! worst value, the limit and its station.

use super::correction::Correction;
use crate::ground::spatial::norm;
use crate::planning::Plan;
use crate::process::run::Outcome as Milled;
use crate::process::way::{Row, Way};
use crate::robot::Joint;
use std::f64::consts::PI;

/// One thing that was checked.
#[derive(Debug, Clone, PartialEq)]
pub struct Checked {
    /// What.
    pub what: &'static str,
    /// Where: a joint, the path.
    pub site: String,
    /// Worst value.
    pub worst: f64,
    /// Its limit; `None`: nothing states one.
    pub limit: Option<f64>,
    /// Whether it holds.
    pub ok: bool,
    /// Arc length of the worst, m.
    pub s_m: f64,
    /// Unit of both.
    pub unit: &'static str,
}

/// A hand this near to straight is singular: |A5|, rad.
const STRAIGHT: f64 = 0.035;
/// Time in which a milling robot's joint reaches its highest speed, s; its speed where none is stated, rad/s.
const RAMP_S: f64 = 0.4;
const FAST: f64 = 1.5;
/// Largest correction, m.
const BOUND: f64 = 5e-3;

/// Checks a corrected motion; `milled` is its run.
pub fn proof(plan: &Plan, way: &Way, correction: &Correction, milled: &Milled) -> Vec<Checked> {
    let rows = way.rows();
    let mut all = Vec::new();
    for (i, joint) in plan.cell.robot.joints.iter().enumerate() {
        all.push(range(rows, i, &joint.name, joint.limits));
        all.extend(
            joint
                .max_speed
                .map(|limit| speed(rows, i, &joint.name, limit)),
        );
        all.push(acceleration(way, &plan.rows, i, joint));
    }
    all.push(singularity(rows));
    all.push(bound(correction));
    all.push(progress(plan, correction));
    all.push(load(milled));
    all
}

/// The row of the largest value.
fn worst(values: impl Iterator<Item = (f64, f64)>) -> (f64, f64) {
    values.fold(
        (f64::NEG_INFINITY, 0.0),
        |a, b| if b.0 > a.0 { b } else { a },
    )
}

/// How far beyond the middle of its range a joint goes, against half the range.
fn range(rows: &[Row], i: usize, site: &str, limits: [f64; 2]) -> Checked {
    let [low, high] = limits;
    let beyond = |row: &Row| (row.joints[i] - high).max(low - row.joints[i]);
    let (excess, s_m) = worst(rows.iter().map(|row| (beyond(row), row.s_m)));
    Checked {
        what: "joint-range",
        site: site.into(),
        worst: excess.to_degrees(),
        limit: Some(0.0),
        ok: excess <= 0.0,
        s_m,
        unit: "deg beyond the range",
    }
}

fn speed(rows: &[Row], i: usize, site: &str, limit: f64) -> Checked {
    let of = |pair: &[Row]| {
        (pair[1].joints[i] - pair[0].joints[i]).abs() / (pair[1].time_s - pair[0].time_s)
    };
    let (worst, s_m) = worst(rows.windows(2).map(|pair| (of(pair), pair[1].s_m)));
    let worst = worst.max(0.0);
    Checked {
        what: "joint-speed",
        site: site.into(),
        worst: worst.to_degrees(),
        limit: Some(limit.to_degrees()),
        ok: worst <= limit,
        s_m,
        unit: "deg/s",
    }
}

/// Where the robot file states no acceleration, a joint is taken to reach its highest speed in [`RAMP_S`], and
/// to do twice what the uncorrected path asks.
fn acceleration(
    way: &Way,
    plan: &[crate::planning::plan::Row],
    i: usize,
    joint: &Joint,
) -> Checked {
    let site = &joint.name;
    let second = |a: f64, b: f64, c: f64, h: f64| ((a - 2.0 * b + c) / (h * h)).abs();
    let drawn = plan
        .windows(3)
        .map(|r| second(r[0].q[i], r[1].q[i], r[2].q[i], r[1].t - r[0].t));
    let usual = (2.0 * drawn.fold(0.0, f64::max)).max(joint.max_speed.unwrap_or(FAST) / RAMP_S);
    let limit = joint.max_acceleration.unwrap_or(usual);
    let triples = way.rows().windows(3).map(|r| {
        let h = r[1].time_s - r[0].time_s;
        (
            second(r[0].joints[i], r[1].joints[i], r[2].joints[i], h),
            r[1].s_m,
        )
    });
    let (worst, s_m) = worst(triples);
    let worst = worst.max(0.0);
    Checked {
        what: "joint-acceleration",
        site: site.clone(),
        worst: worst.to_degrees(),
        limit: Some(limit.to_degrees()),
        ok: worst <= limit,
        s_m,
        unit: "deg/s²",
    }
}

/// Straightness of the hand: how near A5 comes to zero.
fn singularity(rows: &[Row]) -> Checked {
    let bend = |row: &Row| row.joints.get(4).map_or(PI, |q| q.sin().abs().asin());
    let (worst, s_m) = worst(rows.iter().map(|row| (-bend(row), row.s_m)));
    Checked {
        what: "singularity",
        site: "wrist".into(),
        worst: -worst.to_degrees(),
        limit: Some(STRAIGHT.to_degrees()),
        ok: -worst >= STRAIGHT,
        s_m,
        unit: "deg, at least",
    }
}

fn bound(correction: &Correction) -> Checked {
    let (size, s_m) = correction.largest();
    Checked {
        what: "correction",
        site: "path".into(),
        worst: 1e3 * size,
        limit: Some(1e3 * BOUND),
        ok: size <= BOUND,
        s_m,
        unit: "mm",
    }
}

/// The corrected path goes on wherever the programmed one does: the least of its progress per that of
/// the programmed path.
fn progress(plan: &Plan, correction: &Correction) -> Checked {
    let along = |pair: &[crate::planning::plan::Row]| {
        let way = crate::ground::spatial::sub(pair[1].point, pair[0].point);
        let length = norm(way);
        if length < 1e-6 {
            return None;
        }
        let moved = crate::ground::spatial::sub(correction.at(pair[1].s), correction.at(pair[0].s));
        let share = 1.0 + crate::ground::spatial::dot(moved, way) / (length * length);
        Some((-share, pair[1].s))
    };
    let (worst, s_m) = worst(plan.rows.windows(2).filter_map(along));
    let least = if worst.is_finite() { -worst } else { 1.0 };
    Checked {
        what: "progress",
        site: "path".into(),
        worst: least,
        limit: Some(0.0),
        ok: least > 0.0,
        s_m,
        unit: "of the programmed one, at least",
    }
}

/// The stiffness was identified at loads that no file states: the force is shown, without a limit.
fn load(milled: &Milled) -> Checked {
    let (worst, s_m) = worst(milled.course.iter().map(|cut| (norm(cut.force), cut.s_m)));
    Checked {
        what: "stiffness-load",
        site: "tool".into(),
        worst: worst.max(0.0),
        limit: Some(IDENTIFIED),
        ok: worst <= IDENTIFIED,
        s_m,
        unit: "N",
    }
}

/// Load up to which the stiffness of milling robots is measured (source 004: ±1500 N in the workspace),
/// N.
const IDENTIFIED: f64 = 1500.0;
