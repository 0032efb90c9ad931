//! The free turn about the spindle along the path.

use super::cell::{Cell, JOINTS};
use super::follow::Follower;
use super::turn_search::{self, Goal};
use crate::ground::spatial::{V3, cross, dot, rotate, scale, unit};
use crate::measurement::job::Spin;
use crate::motion::statics::compliance;
use crate::motion::{self, Chain, Work, kinematics};
use crate::path::build::Side;
use crate::path::{Path, Quaternion};

/// Stations of the search at most.
const STATIONS: f64 = 800.0;
/// Stations are this far apart where that makes fewer, m.
const APART: f64 = 2e-3;

/// The turn about the spindle over the arc length: a natural cubic spline, so that joint
/// accelerations do not jump.
#[derive(Debug, Clone, PartialEq)]
pub struct SpinLaw {
    axis: V3,
    stations: Vec<f64>,
    /// Turn, rad, and its second derivative, rad/m².
    turns: Vec<[f64; 2]>,
}

impl SpinLaw {
    /// No turn: as the path carries the tool along without twist, or as the file asks.
    pub fn none(cell: &Cell) -> Self {
        Self {
            axis: cell.spindle,
            stations: Vec::new(),
            turns: Vec::new(),
        }
    }

    /// The law that `spin` asks for. A path that fixes its orientations leaves nothing free.
    pub fn of(cell: &Cell, path: &Path, spin: Spin) -> Self {
        let goal = match spin {
            Spin::Fixed => None,
            Spin::Smooth => Some(Goal::Smooth),
            Spin::Stiffest => Some(Goal::Stiffest),
        };
        let goal = goal.filter(|_| path.programme.free_spin);
        let stations = match goal {
            Some(Goal::Stiffest) => apart(path, turn_search::SLOWEST),
            _ => stations(path),
        };
        let found = goal.and_then(|goal| turn_search::search(cell, path, &stations, goal));
        found.map_or_else(
            || Self::none(cell),
            |turns| Self::through(cell, stations, &turns),
        )
    }

    fn through(cell: &Cell, stations: Vec<f64>, turns: &[f64]) -> Self {
        let bends = natural(&stations, turns);
        Self {
            axis: cell.spindle,
            turns: turns.iter().zip(bends).map(|(t, b)| [*t, b]).collect(),
            stations,
        }
    }

    /// The turn at the arc length `s` (m), rad.
    pub fn turn(&self, s: f64) -> f64 {
        let last = self.stations.len();
        if last < 2 {
            return self.turns.first().map_or(0.0, |turn| turn[0]);
        }
        let after = self.stations.partition_point(|station| *station <= s);
        let i = after.clamp(1, last - 1);
        let (from, to) = (self.stations[i - 1], self.stations[i]);
        let wide = to - from;
        let b = ((s - from) / wide).clamp(0.0, 1.0);
        let a = 1.0 - b;
        let ([y0, m0], [y1, m1]) = (self.turns[i - 1], self.turns[i]);
        a * y0 + b * y1 + ((a * a * a - a) * m0 + (b * b * b - b) * m1) * wide * wide / 6.0
    }

    /// An orientation of the path with the turn at the arc length `s` (m).
    pub fn apply(&self, s: f64, orientation: Quaternion) -> Quaternion {
        match self.turns.is_empty() {
            true => orientation,
            false => orientation.turned(scale(self.turn(s), self.axis)),
        }
    }
}

/// Evenly spaced arc lengths from the start to the end, m.
pub fn stations(path: &Path) -> Vec<f64> {
    let count = (path.length / APART).clamp(8.0, STATIONS).round();
    let step = path.length / count;
    (0..=count as usize).map(|k| k as f64 * step).collect()
}

/// Evenly spaced arc lengths that lie at least `least` (m) apart, or only the ends, m.
fn apart(path: &Path, least: f64) -> Vec<f64> {
    let count = (path.length / least).clamp(1.0, STATIONS).floor();
    let step = path.length / count;
    (0..=count as usize).map(|k| k as f64 * step).collect()
}

/// Mean compliance of the robot normal to the path (the direction spindle axis × feed), m/N; `None`
/// if the robot is rigid or a station is out of reach. Where the tool plunges along its spindle there
/// is no normal: those stations do not count.
pub fn mean_compliance(cell: &Cell, path: &Path, law: &SpinLaw) -> Option<f64> {
    let chain = motion::elastic(&cell.robot);
    chain.springs.iter().flatten().next()?;
    let (mut work, mut follower) = (Work::new(&chain), Follower::new(cell));
    let (mut sum, mut count) = (0.0, 0.0);
    for s in stations(path) {
        let orientation = law.apply(s, path.orientation(s, Side::Before));
        let pose = cell.in_base(path.point(s), orientation);
        let q = follower.next(&pose).ok()?;
        if let Some(normal) = normal(cell, path, s, orientation) {
            sum += compliance_along(&chain, &mut work, &q, normal);
            count += 1.0;
        }
    }
    (count > 0.0).then(|| sum / count)
}

/// Spindle axis × feed direction, a unit vector in the base frame; `None` where they are parallel.
pub fn normal(cell: &Cell, path: &Path, s: f64, orientation: Quaternion) -> Option<V3> {
    let spindle = rotate(&orientation.matrix(), cell.spindle);
    let feed = path.piece(s).direction(s, &path.programme.elements);
    let across = cross(spindle, feed);
    let there = dot(across, across) > 1e-12;
    let across = unit(across).filter(|_| there)?;
    Some(rotate(&cell.workpiece.rotation, across))
}

/// nᵀ C n at the tool, m/N.
pub fn compliance_along(chain: &Chain, work: &mut Work, q: &[f64; JOINTS], n: V3) -> f64 {
    kinematics::place(chain, work, &chain.spread(q));
    dot(n, rotate(&compliance(chain, work), n))
}

/// Second derivatives of the natural cubic spline through the values, by elimination.
fn natural(x: &[f64], y: &[f64]) -> Vec<f64> {
    let n = x.len();
    let (mut upper, mut right) = (vec![0.0; n], vec![0.0; n]);
    for i in 1..n.saturating_sub(1) {
        let (before, after) = (x[i] - x[i - 1], x[i + 1] - x[i]);
        let slope = (y[i + 1] - y[i]) / after - (y[i] - y[i - 1]) / before;
        let pivot = 2.0 * (before + after) - before * upper[i - 1];
        upper[i] = after / pivot;
        right[i] = (6.0 * slope - before * right[i - 1]) / pivot;
    }
    for i in (1..n.saturating_sub(1)).rev() {
        right[i] -= upper[i] * right[i + 1];
    }
    right
}
