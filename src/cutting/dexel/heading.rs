//! Where the tool goes, seen from every angle about it: only what faces its motion cuts.

use super::frame::Frame;
use super::rings::Ring;
use crate::ground::spatial::{V3, dot, unit};

/// The outward directions of all angles, and how far each points along the motion.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Heading {
    /// Outward direction, and its cosine to the motion.
    around: Vec<(V3, f64)>,
    /// Cosine of the spindle axis to the motion.
    lift: f64,
}

/// Nearly along or into the motion: within a few degrees of the border.
const ALMOST: f64 = -0.12;
/// Along the motion, but for rounding.
const LEVEL: f64 = 1e-12;

impl Heading {
    /// Turns to a motion along `way` (any length). `directions`: [sin φ, cos φ] of every angle.
    pub fn turn(&mut self, frame: &Frame, directions: &[[f64; 2]], way: V3) {
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
