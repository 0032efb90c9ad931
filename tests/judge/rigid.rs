//! Finite rigid motions and postures of a chain of hinges, for the judges.

use super::algebra::{Quat, V3, axis, cross, minus, plus, scaled, times, turn, turned, unit};

/// A finite rigid motion.
#[derive(Debug, Clone, Copy)]
pub struct Motion {
    /// The turn.
    pub turn: Quat,
    /// What it adds after the turn, m.
    pub shift: V3,
}

impl Motion {
    /// None.
    pub fn still() -> Self {
        Self {
            turn: [1.0, 0.0, 0.0, 0.0],
            shift: [0.0; 3],
        }
    }

    /// Where a place goes.
    pub fn of(self, x: V3) -> V3 {
        plus(turned(self.turn, x), self.shift)
    }

    /// First a turn about a line of the unloaded posture, then this motion.
    pub fn then_about(self, axis: V3, point: V3, angle: f64) -> Self {
        let own = turn(axis, angle);
        let shift = minus(point, turned(own, point));
        Self {
            turn: times(self.turn, own),
            shift: plus(turned(self.turn, shift), self.shift),
        }
    }
}

/// Geometry at zero: axes, points on them, flange, tool centre point.
#[derive(Debug, Clone)]
pub struct Frame {
    pub axes: [V3; 6],
    pub points: [V3; 6],
    pub flange: V3,
    pub tcp: V3,
}

/// Where things of link n are in the posture: the product of the joints before, proximal first.
pub fn postured(frame: &Frame, joints: &[f64; 6], link: usize, x: V3) -> V3 {
    (0..link).rev().fold(x, |x, j| {
        let q = turn(frame.axes[j], joints[j]);
        plus(turned(q, minus(x, frame.points[j])), frame.points[j])
    })
}

/// Which way a direction of link n points in the posture.
pub fn facing(frame: &Frame, joints: &[f64; 6], link: usize, v: V3) -> V3 {
    (0..link)
        .rev()
        .fold(v, |v, j| turned(turn(frame.axes[j], joints[j]), v))
}

/// Two directions across a third.
pub fn across(a: V3) -> [V3; 2] {
    let other = if a[2].abs() < 0.9 { axis(2) } else { axis(0) };
    let first = unit(cross(a, other));
    [first, cross(a, first)]
}

/// A place between two.
pub fn between(a: V3, b: V3, share: f64) -> V3 {
    plus(scaled(a, 1.0 - share), scaled(b, share))
}
