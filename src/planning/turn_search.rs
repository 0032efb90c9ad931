//! The best turn about the spindle over the whole path: a shortest path over stations and angles
//! (dynamic programming), then a descent from the grid to the continuum.

mod descent;

use super::cell::{Cell, JOINTS};
use super::follow::{Follower, squares};
use super::spin::{compliance_along, normal};
use crate::ground::spatial::scale;
use crate::motion::{self, Chain, Work};
use crate::path::build::Side;
use crate::path::{Path, Quaternion};
use descent::Descent;
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};

/// What is least.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Goal {
    /// Sum of squared joint motion.
    Smooth,
    /// Mean compliance normal to the path.
    Stiffest,
}

/// Angles of the grid over a full turn.
const ANGLES: usize = 72;
/// Width of the grid, rad.
const GRID: f64 = TAU / ANGLES as f64;
/// A stiffest turn runs at most this fast, rad/m (90 degrees in 0.1 m).
const TURNING: f64 = 0.5 * PI / 0.1;
/// Stations of a stiffest turn lie at least this far apart, m: one angle of the grid is then not too fast.
pub const SLOWEST: f64 = GRID / TURNING;
/// A smooth turn runs at most this many angles of the grid from one station to the next.
const WINDOW: usize = 6;
/// Weight of squared joint motion (rad²) beside relative compliance: decides where nothing else does.
const TIE: f64 = 1e-4;
/// Weight of squared distance from the start angles: picks one of equals.
const START: f64 = 1e-7;

/// Joint angles of both hands at one station and turn; `None`: out of reach or of limits.
type Node = [Option<[f64; JOINTS]>; 2];

/// Turns at the stations, rad, continuous; `None` if no chain of turns keeps within reach.
pub fn search(cell: &Cell, path: &Path, stations: &[f64], goal: Goal) -> Option<Vec<f64>> {
    let frames: Vec<Quaternion> = stations
        .iter()
        .map(|s| path.orientation(*s, Side::Before))
        .collect();
    let grid = Grid::of(cell, path, stations, &frames)?;
    let window = match goal {
        Goal::Smooth => WINDOW,
        Goal::Stiffest => window(stations),
    };
    let costs = match goal {
        Goal::Smooth => vec![[[0.0; 2]; ANGLES]; stations.len()],
        Goal::Stiffest => grid.compliances(cell, path, stations, &frames),
    };
    let motion = match goal {
        Goal::Smooth => 1.0,
        Goal::Stiffest => TIE,
    };
    let (turns, angles) = grid.shortest(&costs, motion, window)?;
    Some(match goal {
        Goal::Smooth => Descent {
            cell,
            path,
            stations,
            frames: &frames,
            arm: grid.arm,
        }
        .run(turns, angles),
        Goal::Stiffest => rounded(turns),
    })
}

/// Steps of the grid that a stiffest turn may take between stations.
fn window(stations: &[f64]) -> usize {
    let apart = stations.get(1).map_or(0.0, |s| s - stations[0]);
    ((TURNING * apart / GRID * (1.0 + 1e-9)).floor() as usize).clamp(1, ANGLES / 4)
}

/// All postures over stations and turns.
struct Grid {
    nodes: Vec<[Node; ANGLES]>,
    arm: [bool; 2],
    start: [f64; JOINTS],
}

impl Grid {
    fn of(cell: &Cell, path: &Path, stations: &[f64], frames: &[Quaternion]) -> Option<Self> {
        let wrist = cell.wrist.as_ref()?;
        let pose = |k: usize, j: usize| {
            let turned = frames[k].turned(scale(j as f64 * GRID, cell.spindle));
            cell.in_base(path.point(stations[k]), turned)
        };
        let begin = |j: usize| {
            let mut first = Follower::new(cell);
            let q = first.next(&pose(0, j)).ok()?;
            Some((q, first.arm()?))
        };
        let (begin, arm) = (0..ANGLES).find_map(begin)?;
        let node = |k: usize, j: usize| {
            let mut node: Node = [None; 2];
            let postures = wrist.solve_arm(&pose(k, j), &begin, arm);
            for posture in postures.as_slice().iter().filter(|p| p.reachable) {
                node[usize::from(posture.branch[2])] = Some(posture.q);
            }
            node
        };
        let column = |k: usize| std::array::from_fn(|j| node(k, j));
        let mut nodes: Vec<[Node; ANGLES]> =
            (0..stations.len()).into_par_iter().map(column).collect();
        for (j, node) in nodes[0].iter_mut().enumerate() {
            keep_start(cell, node, &pose(0, j), arm);
        }
        Some(Self {
            nodes,
            arm,
            start: cell.start,
        })
    }

    /// Relative compliance normal to the path, divided by the number of stations.
    fn compliances(
        &self,
        cell: &Cell,
        path: &Path,
        stations: &[f64],
        frames: &[Quaternion],
    ) -> Vec<[[f64; 2]; ANGLES]> {
        let chain: Chain = motion::elastic(&cell.robot);
        let column = |k: usize| {
            let mut work = Work::new(&chain);
            let normal = normal(cell, path, stations[k], frames[k]);
            let mut cost = |q: &Option<[f64; JOINTS]>| match (q, normal) {
                (Some(q), Some(n)) => compliance_along(&chain, &mut work, q, n),
                _ => 0.0,
            };
            std::array::from_fn(|j| [0, 1].map(|hand| cost(&self.nodes[k][j][hand])))
        };
        let mut costs: Vec<[[f64; 2]; ANGLES]> =
            (0..stations.len()).into_par_iter().map(column).collect();
        let all = costs.iter().flatten().flatten();
        let largest = all.copied().fold(f64::MIN_POSITIVE, f64::max);
        costs
            .iter_mut()
            .flatten()
            .flatten()
            .for_each(|cost| *cost /= largest);
        costs
    }

    /// The cheapest chain (Bellman 1957): turns, rad, continuous, and the postures of the grid.
    fn shortest(
        &self,
        costs: &[[[f64; 2]; ANGLES]],
        motion: f64,
        window: usize,
    ) -> Option<(Vec<f64>, Vec<[f64; JOINTS]>)> {
        let mut reached = [[f64::INFINITY; 2]; ANGLES];
        for j in 0..ANGLES {
            for hand in 0..2 {
                if let Some(q) = &self.nodes[0][j][hand] {
                    reached[j][hand] = costs[0][j][hand] + START * squares(q, &self.start);
                }
            }
        }
        let mut from: Vec<[[(u16, u8); 2]; ANGLES]> = Vec::with_capacity(self.nodes.len());
        for (k, costs) in costs.iter().enumerate().skip(1) {
            let (next, came) = self.step(k, &reached, costs, motion, window);
            reached = next;
            from.push(came);
        }
        self.back(&reached, &from)
    }

    #[allow(clippy::type_complexity)]
    fn step(
        &self,
        k: usize,
        reached: &[[f64; 2]; ANGLES],
        costs: &[[f64; 2]; ANGLES],
        motion: f64,
        window: usize,
    ) -> ([[f64; 2]; ANGLES], [[(u16, u8); 2]; ANGLES]) {
        let mut next = [[f64::INFINITY; 2]; ANGLES];
        let mut came = [[(0, 0); 2]; ANGLES];
        for (j, hand) in (0..2 * ANGLES).map(|n| (n / 2, n % 2)) {
            let Some(q) = &self.nodes[k][j][hand] else {
                continue;
            };
            for i in (0..=2 * window).map(|d| (j + ANGLES + d - window) % ANGLES) {
                for (other, reached) in reached[i].iter().enumerate() {
                    let Some(before) = &self.nodes[k - 1][i][other] else {
                        continue;
                    };
                    let cost = reached + motion * wrapped_squares(q, before);
                    if cost < next[j][hand] {
                        next[j][hand] = cost;
                        came[j][hand] = (i as u16, other as u8);
                    }
                }
            }
            next[j][hand] += costs[j][hand];
        }
        (next, came)
    }

    fn back(
        &self,
        reached: &[[f64; 2]; ANGLES],
        from: &[[[(u16, u8); 2]; ANGLES]],
    ) -> Option<(Vec<f64>, Vec<[f64; JOINTS]>)> {
        let all = (0..2 * ANGLES).map(|n| (n / 2, n % 2));
        let best = all.min_by(|a, b| reached[a.0][a.1].total_cmp(&reached[b.0][b.1]))?;
        if !reached[best.0][best.1].is_finite() {
            return None;
        }
        let mut chain = vec![best];
        for came in from.iter().rev() {
            let (j, hand) = *chain.last()?;
            let (i, other) = came[j][hand];
            chain.push((usize::from(i), usize::from(other)));
        }
        chain.reverse();
        let postures = chain.iter().enumerate();
        let postures = postures.map(|(k, (j, hand))| self.nodes[k][*j][*hand]);
        let mut turns: Vec<f64> = Vec::with_capacity(chain.len());
        for (j, _) in &chain {
            let near = turns.last().copied().unwrap_or(0.0);
            let turn = *j as f64 * GRID;
            turns.push(turn + TAU * ((near - turn) / TAU).round());
        }
        Some((turns, postures.collect::<Option<Vec<_>>>()?))
    }
}

/// At the first station only the posture counts that the start angles pick.
fn keep_start(cell: &Cell, node: &mut Node, pose: &crate::ground::spatial::Pose, arm: [bool; 2]) {
    let mut follower = Follower::new(cell);
    let picked = follower
        .next(pose)
        .ok()
        .filter(|_| follower.arm() == Some(arm));
    for hand in node.iter_mut() {
        let same = |q: &[f64; JOINTS]| picked.is_some_and(|p| wrapped_squares(q, &p) < 1e-12);
        *hand = hand.filter(same);
    }
}

/// Sum of squared differences by the shorter way round, rad².
fn wrapped_squares(a: &[f64; JOINTS], b: &[f64; JOINTS]) -> f64 {
    let part = |(a, b): (&f64, &f64)| {
        let d = a - b;
        let d = if d.abs() > PI {
            d - TAU * (d / TAU).round()
        } else {
            d
        };
        d * d
    };
    a.iter().zip(b).map(part).sum()
}

/// The stairs of the grid made round: a binomial mean over neighbours.
fn rounded(mut turns: Vec<f64>) -> Vec<f64> {
    for _ in 0..8 {
        let old = turns.clone();
        for i in 1..turns.len().saturating_sub(1) {
            turns[i] = 0.25 * (old[i - 1] + 2.0 * old[i] + old[i + 1]);
        }
    }
    turns
}
