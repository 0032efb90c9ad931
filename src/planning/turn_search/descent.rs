//! From the grid of turns to the continuum.

use crate::ground::spatial::scale;
use crate::path::{Path, Quaternion};
use crate::planning::cell::{Cell, JOINTS};
use crate::planning::follow::{Follower, squares};
use std::f64::consts::TAU;

/// Gauss–Newton on the sum of squared joint motion between stations.
pub(super) struct Descent<'a> {
    pub(super) cell: &'a Cell,
    pub(super) path: &'a Path,
    pub(super) stations: &'a [f64],
    pub(super) frames: &'a [Quaternion],
    pub(super) arm: [bool; 2],
}

impl Descent<'_> {
    pub(super) fn run(&self, turns: Vec<f64>, near: Vec<[f64; JOINTS]>) -> Vec<f64> {
        let Some(mut angles) = self.angles(&turns, &near) else {
            return turns;
        };
        let (mut turns, mut brake) = (turns, 1e-9);
        for _ in 0..40 {
            let Some(slopes) = self.slopes(&turns, &angles) else {
                break;
            };
            let change = step(&angles, &slopes, brake);
            let trial: Vec<f64> = turns.iter().zip(&change).map(|(t, d)| t + d).collect();
            let found = self.angles(&trial, &angles);
            let better = found.filter(|found| cost(found) < cost(&angles));
            match better {
                Some(found) => {
                    let gained = 1.0 - cost(&found) / cost(&angles).max(f64::MIN_POSITIVE);
                    (turns, angles, brake) = (trial, found, (0.1 * brake).max(1e-9));
                    if gained < 1e-9 {
                        break;
                    }
                }
                None if brake > 1e3 => break,
                None => brake = (brake * 30.0).max(1e-6),
            }
        }
        turns
    }

    /// Joint angles at the turns, nearest to those known and running on from station to station.
    fn angles(&self, turns: &[f64], near: &[[f64; JOINTS]]) -> Option<Vec<[f64; JOINTS]>> {
        let mut all: Vec<[f64; JOINTS]> = Vec::with_capacity(turns.len());
        for (k, turn) in turns.iter().enumerate() {
            let q = self.at(k, *turn, &near[k])?;
            let last = all.last().copied().unwrap_or(q);
            all.push(std::array::from_fn(|i| {
                q[i] + TAU * ((last[i] - q[i]) / TAU).round()
            }));
        }
        Some(all)
    }

    fn at(&self, k: usize, turn: f64, near: &[f64; JOINTS]) -> Option<[f64; JOINTS]> {
        let turned = self.frames[k].turned(scale(turn, self.cell.spindle));
        let pose = self.cell.in_base(self.path.point(self.stations[k]), turned);
        Follower::from(self.cell, Some(self.arm), *near)
            .next(&pose)
            .ok()
    }

    /// ∂q/∂turn at every station.
    fn slopes(&self, turns: &[f64], angles: &[[f64; JOINTS]]) -> Option<Vec<[f64; JOINTS]>> {
        const H: f64 = 1e-5;
        let slope = |k: usize| {
            let [before, after] = [-H, H].map(|h| self.at(k, turns[k] + h, &angles[k]));
            let (before, after) = (before?, after?);
            Some(std::array::from_fn(|i| 0.5 * (after[i] - before[i]) / H))
        };
        (0..turns.len()).map(slope).collect()
    }
}

fn cost(angles: &[[f64; JOINTS]]) -> f64 {
    angles
        .windows(2)
        .map(|pair| squares(&pair[1], &pair[0]))
        .sum()
}

/// Solves the tridiagonal normal equations of the differences of neighbours.
fn step(angles: &[[f64; JOINTS]], slopes: &[[f64; JOINTS]], brake: f64) -> Vec<f64> {
    let n = angles.len();
    let dot =
        |a: &[f64; JOINTS], b: &[f64; JOINTS]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let gap =
        |k: usize| -> [f64; JOINTS] { std::array::from_fn(|i| angles[k + 1][i] - angles[k][i]) };
    let (mut upper, mut right) = (vec![0.0; n], vec![0.0; n]);
    for k in 0..n {
        let own = dot(&slopes[k], &slopes[k]);
        let (mut diagonal, mut r) = (brake * (1.0 + own), 0.0);
        let mut lower = 0.0;
        if k > 0 {
            diagonal += own;
            r -= dot(&slopes[k], &gap(k - 1));
            lower = -dot(&slopes[k - 1], &slopes[k]);
        }
        if k + 1 < n {
            diagonal += own;
            r += dot(&slopes[k], &gap(k));
        }
        let (before, done) = match k {
            0 => (0.0, 0.0),
            _ => (upper[k - 1], right[k - 1]),
        };
        let pivot = diagonal - lower * before;
        upper[k] = match k + 1 < n {
            true => -dot(&slopes[k], &slopes[k + 1]) / pivot,
            false => 0.0,
        };
        right[k] = (r - lower * done) / pivot;
    }
    for k in (0..n.saturating_sub(1)).rev() {
        right[k] -= upper[k] * right[k + 1];
    }
    right
}
