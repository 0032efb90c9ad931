//! The directions in which the tool's angles count.

use crate::ground::spatial::{V3, add, cross, dot, normals, scale, unit};

/// Directions across the axis from which angles count: φ from `y` towards `x`, as seen from the
/// spindle clockwise.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// φ = 90°.
    pub x: V3,
    /// φ = 0.
    pub y: V3,
    /// The axis, into the spindle.
    pub z: V3,
}

impl Frame {
    /// The frame whose x lies nearest to `forward`.
    pub fn towards(forward: V3, z: V3) -> Self {
        let flat = |v: V3| unit(add(v, scale(-dot(v, z), z)));
        let x = flat(forward).unwrap_or_else(|| normals(z).0);
        Self {
            x,
            y: cross(z, x),
            z,
        }
    }

    /// Outward direction at tooth angle φ, given as [sin φ, cos φ].
    #[inline]
    pub fn outward(&self, [sin, cos]: [f64; 2]) -> V3 {
        [0, 1, 2].map(|k| sin * self.x[k] + cos * self.y[k])
    }

    /// A vector of this frame in the workpiece frame.
    pub fn out(&self, v: V3) -> V3 {
        [0, 1, 2].map(|k| v[0] * self.x[k] + v[1] * self.y[k] + v[2] * self.z[k])
    }
}
