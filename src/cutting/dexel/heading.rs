//! Where the tool goes, seen from every angle about it: only what faces its motion cuts.

use super::frame::Frame;
use super::rings::Ring;
use crate::ground::spatial::{V3, dot, scale, sub, unit};

/// The outward directions of all angles, and how far each points along the motion.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Heading {
    /// Outward direction, and its cosine to the motion.
    around: Vec<(V3, f64)>,
    /// From the envelope to half of the chip, as far as it leads across the motion, m.
    halfway: Vec<V3>,
    /// Cosine of the spindle axis to the motion.
    lift: f64,
    /// The motion across the axis, m.
    level: V3,
}

/// Nearly along or into the motion: within a few degrees of the border.
const ALMOST: f64 = -0.12;
/// Along the motion, but for rounding.
const LEVEL: f64 = 1e-12;

impl Heading {
    /// Turns to a motion along `way`, of the passing of one tooth. `directions`: [sin φ, cos φ] of every angle.
    pub fn turn(&mut self, frame: &Frame, directions: &[[f64; 2]], way: V3) {
        let level = sub(way, scale(dot(way, frame.z), frame.z));
        let feed = unit(level).unwrap_or([0.0; 3]);
        self.level = level;
        let half = |direction: &[f64; 2]| {
            let out = frame.outward(*direction);
            let across = sub(out, scale(dot(out, feed), feed));
            scale(-0.5 * dot(level, out).max(0.0), across)
        };
        self.halfway.clear();
        self.halfway.extend(directions.iter().map(half));
        let way = unit(way).unwrap_or([0.0; 3]);
        let seen = |direction: &[f64; 2]| {
            let out = frame.outward(*direction);
            (out, dot(out, way))
        };
        self.around.clear();
        self.around.extend(directions.iter().map(seen));
        self.lift = dot(frame.z, way);
    }

    /// Outward direction at an angle.
    #[inline]
    pub fn outward(&self, k: usize) -> V3 {
        self.around[k].0
    }

    /// From the envelope to half of the chip that a motion takes at an angle, across the motion, m: where the chip of a
    /// ray is cut off by a wall, half of it lies beyond.
    #[inline]
    pub fn halfway(&self, k: usize) -> V3 {
        self.halfway[k]
    }

    /// What a motion takes at an angle beside radius × chip of first order, m² per rad: c²/2 cos 2φ, the chip along the rays of a
    /// circle that moves by c.
    #[inline]
    pub fn second_order(&self, k: usize) -> f64 {
        let ahead = dot(self.level, self.around[k].0);
        0.5 * dot(self.level, self.level) - ahead * ahead
    }

    #[inline]
    fn ahead(&self, ring: &Ring, k: usize) -> f64 {
        let [sin, cos] = ring.disc.normal;
        sin * self.around[k].1 - cos * self.lift
    }

    /// Whether a ring faces the motion at an angle, or nearly does.
    #[inline]
    pub fn nears(&self, ring: &Ring, k: usize) -> bool {
        self.ahead(ring, k) > ALMOST * ring.disc.normal[0] + LEVEL
    }

    /// Whether it faces the motion, or lies along it.
    #[inline]
    pub fn leads(&self, ring: &Ring, k: usize) -> bool {
        self.ahead(ring, k) > -LEVEL * ring.disc.normal[0]
    }

    /// Whether it may at any angle: a flat end does where the tool plunges.
    #[inline]
    pub fn may_lead(&self, ring: &Ring) -> bool {
        let [sin, cos] = ring.disc.normal;
        sin > 0.0 || -cos * self.lift > 0.0
    }
}
