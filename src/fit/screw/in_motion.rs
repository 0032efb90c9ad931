//! The measured axis in motion, corrected in several ways: does the speed along the stroke hold, and the
//! position (source 003, sections 2.1 and 3.1)?

use super::Account;
use super::groups::{Group, Joint, greedy};
use super::positions::{Target, in_mm};
use crate::measurement::pitch_table::PitchTable;
use crate::motion::servo::{BANDWIDTH, Drive, Instant, Loop, Screw, Stroke, course};

/// What an axis must hold in work.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Demand {
    /// Speed along the stroke, m/s.
    pub speed: f64,
    /// How far the speed may be off, m/s.
    pub speed_tolerance: f64,
    /// How far the position may be off, m.
    pub position_tolerance: f64,
}

impl Demand {
    /// (5 ± 0.25) m/min and ± 0.02 mm, at another speed (m/s) with the same share (source 003, 2.1).
    pub fn at(speed: f64) -> Self {
        Self {
            speed,
            speed_tolerance: 0.05 * speed,
            position_tolerance: 20e-6,
        }
    }
}

/// One way to correct, and what the axis does with it.
#[derive(Debug, Clone)]
pub struct Run {
    /// Its key in the JSON.
    pub key: &'static str,
    /// In words.
    pub name: &'static str,
    /// The way forward where the speed should be constant: of every stretch the samples whose speed and
    /// whose position are farthest off.
    pub course: Vec<[Instant; 2]>,
    /// Least and largest speed where it should be constant, both ways, m/s; none on too short a stroke.
    pub speed: Option<[f64; 2]>,
    /// Least and largest error of the position there, m.
    pub error: Option<[f64; 2]>,
}

impl Run {
    /// Whether the speed holds.
    pub fn holds_speed(&self, demand: &Demand) -> Option<bool> {
        let off = self.speed?.map(|v| (v - demand.speed).abs());
        Some(off[0].max(off[1]) <= demand.speed_tolerance)
    }

    /// Whether the position holds.
    pub fn holds_position(&self, demand: &Demand) -> Option<bool> {
        let off = self.error?.map(f64::abs);
        Some(off[0].max(off[1]) <= demand.position_tolerance)
    }
}

/// A correction: µm to be added to the command, at a position in mm, forward or not.
type Correction = Box<dyn Fn(f64, bool) -> f64>;
/// Key, name and correction.
type Way = (&'static str, &'static str, Correction);

/// The longest stroke that is simulated, m: the first part of a longer axis.
pub const LONGEST: f64 = 2.0;
/// Acceleration of the stroke, m/s², where a quarter of it is enough to get to speed and back.
const ACCELERATION: f64 = 2.0;
/// Rest at the ends, s.
const REST: f64 = 0.1;
/// Pitch where the file states none, m: it only says how heavy the screw is.
const PITCH: f64 = 5e-3;

/// Leads the axis over the targets and back with each correction. The screw is what the means of both
/// directions say, smooth in between; an error that repeats with every turn is in it only as far as the
/// targets show it.
pub fn in_motion(account: &Account, demand: &Demand) -> Vec<Run> {
    let points = means(account);
    if points.len() < 2 || account.groups.is_empty() {
        return Vec::new();
    }
    let drive = Drive::of_pitch(account.pitch.unwrap_or(PITCH));
    let control = Loop::with_bandwidth(&drive, BANDWIDTH);
    let gap = lost_motion(&account.kept);
    let [from, to] = [points[0][0], points[points.len() - 1][0]].map(|mm| mm * 1e-3);
    let to = to.min(from + LONGEST);
    let stroke = Stroke {
        ends: [from, to],
        speed: demand.speed,
        acceleration: ACCELERATION.max(4.0 * demand.speed.powi(2) / (to - from)),
        rest: REST,
    };
    let error = |x: f64| 1e-6 * smooth(&points, x * 1e3);
    let screw = Screw {
        error: &error,
        play: gap.max(0.0),
    };
    let with = |(key, name, correction): Way| {
        let metres = |x: f64, forward: bool| 1e-6 * correction(x * 1e3, forward);
        let mut watch = Watch {
            run: Run {
                key,
                name,
                course: Vec::new(),
                speed: None,
                error: None,
            },
            speed: demand.speed,
            stretch: 0.5 * stroke.duration() / POINTS,
            number: -1,
        };
        course(&drive, &control, &screw, &stroke, &metres, |now| {
            watch.see(now)
        });
        watch.run
    };
    corrections(account, &points, gap)
        .into_iter()
        .map(with)
        .collect()
}

/// Points of a curve.
const POINTS: f64 = 1200.0;

/// What is kept of a course, sample by sample.
struct Watch {
    run: Run,
    speed: f64,
    stretch: f64,
    number: i64,
}

impl Watch {
    fn see(&mut self, now: Instant) {
        if !now.steady {
            return;
        }
        let speed = if now.forward { now.speed } else { -now.speed };
        widen(&mut self.run.speed, speed);
        widen(&mut self.run.error, now.error);
        if !now.forward {
            return;
        }
        let number = (now.time / self.stretch) as i64;
        match self.run.course.last_mut() {
            Some([fast, far]) if number == self.number => {
                let off = |i: &Instant| (i.speed - self.speed).abs();
                if off(&now) > off(fast) {
                    *fast = now;
                }
                if now.error.abs() > far.error.abs() {
                    *far = now;
                }
            }
            _ => self.run.course.push([now; 2]),
        }
        self.number = number;
    }
}

fn widen(range: &mut Option<[f64; 2]>, x: f64) {
    let [low, high] = range.unwrap_or([x, x]);
    *range = Some([low.min(x), high.max(x)]);
}

/// Every way to correct: its key, its name, and what it adds.
fn corrections(account: &Account, points: &[[f64; 2]], gap: f64) -> Vec<Way> {
    let (steps, lines) = (account.table(false), account.table(false));
    let limit = account.limit_um;
    let free = greedy(points, limit, Joint::Free);
    let meeting = greedy(points, limit, Joint::Continuous);
    vec![
        ("none", "none", boxed(|_, _| 0.0)),
        (
            "points",
            "point table",
            boxed(move |x, forward| nearest(&steps, x, forward)),
        ),
        (
            "lines",
            "point table, straight lines between",
            boxed(move |x, forward| lines.correction_um(x, forward)),
        ),
        (
            "quadratics",
            "grouped quadratics",
            boxed(move |x, forward| quadratic(&free, gap, x, forward)),
        ),
        (
            "continuous",
            "grouped quadratics that meet",
            boxed(move |x, forward| quadratic(&meeting, gap, x, forward)),
        ),
    ]
}

fn boxed(correction: impl Fn(f64, bool) -> f64 + 'static) -> Correction {
    Box::new(correction)
}

/// What stands in the table for the nearest target.
fn nearest(table: &PitchTable, x: f64, forward: bool) -> f64 {
    let after = table.rows.partition_point(|row| row.target_mm <= x);
    let around = [after.checked_sub(1), Some(after)].into_iter().flatten();
    let rows = around.filter_map(|i| table.rows.get(i));
    let row = rows.min_by(|a, b| (a.target_mm - x).abs().total_cmp(&(b.target_mm - x).abs()));
    row.map_or(0.0, |row| {
        if forward {
            row.forward_um
        } else {
            row.backward_um
        }
    })
}

/// Less the groups, half the gap to either side. Between the last target of a group and the first of the
/// next, of which neither speaks, the correction runs straight.
fn quadratic(groups: &[Group], gap: f64, x: f64, forward: bool) -> f64 {
    let half = 0.5e6 * if forward { gap } else { -gap };
    let next = groups
        .partition_point(|group| group.to_mm < x)
        .min(groups.len() - 1);
    let (own, before) = (&groups[next], next.checked_sub(1).map(|i| &groups[i]));
    let middle = match before.filter(|_| x < own.from_mm) {
        None => own.at(x),
        Some(before) => {
            let share = (x - before.to_mm) / (own.from_mm - before.to_mm);
            (1.0 - share) * before.at(before.to_mm) + share * own.at(own.from_mm)
        }
    };
    half - middle
}

/// Means of both directions at the targets: mm, µm.
fn means(account: &Account) -> Vec<[f64; 2]> {
    let point = |t: &Target| Some([in_mm(t.at), t.mean()? * 1e6]);
    account.kept.iter().filter_map(point).collect()
}

/// Mean of backward less forward, m, with its sign; 0 where one way was measured.
fn lost_motion(kept: &[Target]) -> f64 {
    let both = |t: &Target| Some(Target::middle(&t.backward)? - Target::middle(&t.forward)?);
    let all: Vec<f64> = kept.iter().filter_map(both).collect();
    Target::middle(&all).unwrap_or(0.0)
}

/// A smooth curve through points with rising x: cubic pieces whose slopes at the points are those of the
/// parabola through the neighbours (Hermite, Bessel).
fn smooth(points: &[[f64; 2]], x: f64) -> f64 {
    let last = points.len() - 2;
    let i = points
        .partition_point(|p| p[0] <= x)
        .saturating_sub(1)
        .min(last);
    let ([x0, y0], [x1, y1]) = (points[i], points[i + 1]);
    let (h, t) = (x1 - x0, ((x - x0) / (x1 - x0)).clamp(0.0, 1.0));
    let (m0, m1) = (slope(points, i) * h, slope(points, i + 1) * h);
    let (t2, t3) = (t * t, t * t * t);
    y0 * (2.0 * t3 - 3.0 * t2 + 1.0)
        + m0 * (t3 - 2.0 * t2 + t)
        + y1 * (3.0 * t2 - 2.0 * t3)
        + m1 * (t3 - t2)
}

fn slope(points: &[[f64; 2]], i: usize) -> f64 {
    let secant = |j: usize| (points[j + 1][1] - points[j][1]) / (points[j + 1][0] - points[j][0]);
    match i {
        0 => secant(0),
        _ if i + 1 == points.len() => secant(i - 1),
        _ => {
            let (left, right) = (
                points[i][0] - points[i - 1][0],
                points[i + 1][0] - points[i][0],
            );
            (secant(i - 1) * right + secant(i) * left) / (left + right)
        }
    }
}
