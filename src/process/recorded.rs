//! Recorded joint angles in the place of the plan (source 001, figure 3): where the controller really led
//! the tool, its rounded corners and its swing after a turn included.

use super::run::Outcome as Milled;
use super::way::{Row, Way};
use crate::cutting::cutter::Cutter;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::{V3, add, norm, rotate, scale, sub};
use crate::ground::stats;
use crate::measurement::recorded_joints::RecordedJoints;
use crate::motion::{Work, forward_kinematics};
use crate::path::Path;
use crate::path::build::Side;
use crate::path::nearest::sought;
use crate::planning::Plan;
use std::f64::consts::TAU;

/// A recorded motion beside the path that was asked for.
#[derive(Debug, Clone)]
pub struct Recorded {
    /// The motion, the robot being rigid.
    pub way: Way,
    /// Time (s) and how far the recorded tip is from the path, m, workpiece frame.
    aside: Vec<(f64, V3)>,
    /// How far along the path it leads, m.
    reached_m: f64,
}

/// A recording that never comes as near to the path's begin, or is half of the time farther from the path
/// than this, is one of another job, m.
const ANOTHER_JOB: f64 = 0.02;
/// What a recording may miss of the last cut, m: controllers round, and stop to log.
const LAST: f64 = 2e-3;
/// How far ahead of the last place the next is looked for: m, and per way of the recorded tip.
const AHEAD: f64 = 1e-3;
const FASTER: f64 = 3.0;

impl Recorded {
    /// Lays a recording along the path of a plan.
    ///
    /// # Errors
    /// A recording of another job.
    pub fn of(plan: &Plan, recorded: &RecordedJoints) -> Outcome<Self> {
        let mut rows = rows(plan, recorded);
        let begin = begin(plan, &rows);
        let late = norm(sub(rows[begin].tip, plan.path.point(0.0)));
        if late > ANOTHER_JOB {
            return Err(another(late).in_file(&recorded.path));
        }
        let mut s = 0.0;
        let mut aside = Vec::with_capacity(rows.len());
        for i in 0..rows.len() {
            if i > begin {
                let moved = norm(sub(rows[i].tip, rows[i - 1].tip));
                s = place(&plan.path, rows[i].tip, s, AHEAD + FASTER * moved);
            }
            rows[i].s_m = s;
            let counts = i >= begin && s < plan.path.length;
            let off = sub(rows[i].tip, plan.path.point(s));
            aside.push((rows[i].time_s, if counts { off } else { [0.0; 3] }));
        }
        let way = Way::new(rows).ok_or_else(|| Problem::new("holds no motion", "record the job"));
        let far = stats::median(
            &aside[begin..]
                .iter()
                .map(|a| norm(a.1))
                .collect::<Vec<f64>>(),
        );
        match far <= ANOTHER_JOB {
            true => Ok(Self {
                way: way?,
                aside,
                reached_m: s,
            }),
            false => Err(another(far).in_file(&recorded.path)),
        }
    }

    /// How far along the path it leads, m, where the path would still cut what it has `left`.
    pub fn ends_before(&self, plan: &Plan, left: &Cutter) -> Option<f64> {
        let (path, from) = (&plan.path, self.reached_m + LAST);
        let places = ((path.length - from) / AHEAD).max(0.0) as usize;
        let cuts = |i: usize| is_in(left, path, from + AHEAD * i as f64);
        (1..=places).any(cuts).then_some(self.reached_m)
    }

    /// How far the recorded tip was from the path, largest and root mean square, m.
    pub fn off_path(&self) -> [f64; 2] {
        let sizes = self.aside.iter().map(|a| norm(a.1));
        let squares: f64 = sizes.clone().map(|x| x * x).sum();
        let rms = (squares / self.aside.len().max(1) as f64).sqrt();
        [sizes.fold(0.0, f64::max), rms]
    }

    /// Counts what the controller did beside the path as deviation.
    pub fn add_to(&self, milled: &mut Milled) {
        for cut in &mut milled.course {
            cut.deviation = add(cut.deviation, self.at(cut.time_s));
        }
    }

    fn at(&self, time_s: f64) -> V3 {
        let after = self.aside.partition_point(|a| a.0 < time_s);
        let last = self.aside.len() - 1;
        let [a, b] = [after.saturating_sub(1), after.min(last)].map(|i| self.aside[i]);
        match b.0 > a.0 {
            true => {
                let share = ((time_s - a.0) / (b.0 - a.0)).clamp(0.0, 1.0);
                add(a.1, scale(share, sub(b.1, a.1)))
            }
            false => b.1,
        }
    }
}

/// Whether the tool stands in material at an arc length of a path, m: with its lowest point, or its rim.
fn is_in(left: &Cutter, path: &Path, s: f64) -> bool {
    let (tip, turned) = (path.point(s), path.orientation(s, Side::Before).matrix());
    let [x, y, axis] = [0, 1, 2].map(|k| [turned[0][k], turned[1][k], turned[2][k]]);
    let (radius, corner) = (left.tool().radius_m, left.tool().corner_radius_m);
    let lifted = |by: f64| add(tip, scale(by + INSIDE * radius, axis));
    let rim = (0..RIM).map(|k| {
        let (sin, cos) = (TAU * k as f64 / RIM as f64).sin_cos();
        let out = add(scale(cos, x), scale(sin, y));
        add(lifted(corner), scale((1.0 - INSIDE) * radius, out))
    });
    std::iter::once(lifted(0.0))
        .chain(rim)
        .any(|point| left.stock().depth(point) > 0.0)
}

/// Share of the radius by which a place lies within the tool: walls that it left touch it.
const INSIDE: f64 = 0.05;
/// Places of a rim that are asked: 15 degrees apart.
const RIM: usize = 24;

fn another(off: f64) -> Problem {
    Problem::new(
        format!(
            "leads the tool {:.0} mm beside the path of the job",
            1e3 * off
        ),
        "give the recording of this job; check signs and zeros of the angles, and [workpiece]",
    )
}

fn rows(plan: &Plan, recorded: &RecordedJoints) -> Vec<Row> {
    let mut work = Work::new(&plan.cell.chain);
    let row = |(time_s, q): &(f64, [f64; 6])| {
        let pose = forward_kinematics(&plan.cell.chain, &mut work, q);
        let pose = plan.cell.in_workpiece(&pose);
        Row {
            time_s: *time_s,
            s_m: 0.0,
            tip: pose.point,
            axis: rotate(&pose.rotation, plan.cell.spindle),
            joints: q.to_vec(),
        }
    };
    recorded.rows.iter().map(row).collect()
}

/// The row from which the recording follows the path: the first that is as near to its begin as any,
/// within what a search resolves.
fn begin(plan: &Plan, rows: &[Row]) -> usize {
    let start = plan.path.point(0.0);
    let far = |row: &Row| norm(sub(row.tip, start));
    let least = rows.iter().map(far).fold(f64::INFINITY, f64::min);
    let near = |row: &Row| far(row) <= least + AHEAD;
    let first = rows.iter().position(near).unwrap_or(0);
    // within the first visit of that neighbourhood, the nearest
    let visit = rows[first..].iter().take_while(|row| near(row));
    let best = visit
        .enumerate()
        .min_by(|a, b| far(a.1).total_cmp(&far(b.1)));
    first + best.map_or(0, |b| b.0)
}

/// Arc length of the place of the path nearest to a point, from `s` on, at most `ahead` farther, m.
fn place(path: &Path, to: V3, s: f64, ahead: f64) -> f64 {
    let (point, feed) = (|s| path.point(s), |s| path.direction(s));
    sought(point, feed, to, s..=(s + ahead).min(path.length).max(s))
}
