//! What inverse kinematics answers: postures, their branches, their limits.

use crate::ground::arctangent::whole_turns;
use std::f64::consts::TAU;

/// Which degeneracies a posture is close to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Singularity {
    /// The wrist centre lies on A1: A1 is free.
    pub shoulder: bool,
    /// The arm is stretched or folded: A2 and A3 branches meet.
    pub elbow: bool,
    /// A4 and A6 are in line: only their sum is fixed.
    pub wrist: bool,
}

impl Singularity {
    /// Whether the posture is near any singularity.
    pub fn any(&self) -> bool {
        self.shoulder || self.elbow || self.wrist
    }
}

/// One posture that reaches the pose.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Posture {
    /// Joint angles, rad.
    pub q: [f64; 6],
    /// Branches taken: first or second solution for A1, A3, A5.
    pub branch: [bool; 3],
    /// Whether every joint is inside its limits.
    pub reachable: bool,
    /// Degeneracies close by.
    pub singular: Singularity,
}

/// All postures of one pose: at most eight, no heap.
#[derive(Debug, Clone, Copy, Default)]
pub struct Postures {
    list: [Posture; 8],
    len: usize,
}

impl Postures {
    /// The postures found, in the order of their branches.
    #[inline]
    pub fn as_slice(&self) -> &[Posture] {
        &self.list[..self.len]
    }

    #[inline(always)]
    pub(super) fn push(&mut self, posture: Posture) {
        if let Some(slot) = self.list.get_mut(self.len) {
            *slot = posture;
            self.len += 1;
        }
    }

    /// The reachable posture with the smallest largest joint step from `from` (rad).
    pub fn nearest(&self, from: &[f64; 6]) -> Option<&Posture> {
        let step = |posture: &Posture| {
            posture
                .q
                .iter()
                .zip(from)
                .map(|(a, b)| (a - b).abs())
                .fold(0.0, f64::max)
        };
        let reachable = self.as_slice().iter().filter(|posture| posture.reachable);
        reachable.min_by(|a, b| step(a).total_cmp(&step(b)))
    }
}

/// Angles beyond their limits by less than this are inside, rad: rounding.
const SLACK: f64 = 1e-9;

/// The full turn of every angle that lies inside the limits nearest to `seed`, and whether each has
/// one; one that has none lies within half a turn of zero.
#[inline(always)]
pub(super) fn within(q: &[f64; 6], seed: &[f64; 6], limits: &[[f64; 2]; 6]) -> ([f64; 6], bool) {
    let mut turned = *q;
    for (angle, seed) in turned.iter_mut().zip(seed) {
        *angle += TAU * whole_turns(seed - *angle);
    }
    let mut reachable = true;
    for (angle, limits) in turned.iter_mut().zip(limits) {
        let [low, high] = [limits[0] - SLACK, limits[1] + SLACK];
        if !(*angle >= low && *angle <= high) {
            reachable &= bring(angle, low, high);
        }
    }
    (turned, reachable)
}

/// Brings an angle by full turns inside limits that it is outside of; within half a turn of zero if
/// there is no such turn.
fn bring(angle: &mut f64, low: f64, high: f64) -> bool {
    let brought = match *angle < low {
        true => *angle + TAU * ((low - *angle) / TAU).ceil(),
        false => *angle - TAU * ((*angle - high) / TAU).ceil(),
    };
    let inside = brought >= low && brought <= high;
    *angle = match inside {
        true => brought,
        false => *angle - TAU * whole_turns(*angle),
    };
    inside
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_turn_into_their_limits_next_to_the_seed() {
        let wide = [-6.0, 6.0];
        let limits = [
            [-3.15, 3.15],
            [-2.5, 0.0],
            [0.5, 9.0],
            wide,
            wide,
            [20.0, 40.0],
        ];
        let q = [3.1, 0.3, -3.0, 2.0, -2.0, 0.0];
        let seed = [-3.1, 0.0, 0.0, -4.0, 7.0, 0.0];
        let (turned, reachable) = within(&q, &seed, &limits);
        let wanted = [3.1, 0.3, -3.0 + TAU, 2.0 - TAU, -2.0 + TAU, 4.0 * TAU];
        assert!(!reachable, "A2 has no turn inside");
        for (a, b) in turned.iter().zip(wanted) {
            assert!((a - b).abs() < 1e-14, "{turned:?}");
        }
        let limits = [
            [-3.15, 3.15],
            [-6.0, 0.0],
            [0.5, 9.0],
            wide,
            wide,
            [20.0, 40.0],
        ];
        assert!(within(&q, &seed, &limits).1);
    }
}
