//! The two shapes of a move.

use crate::ground::vector::V3;

/// Shape of a move between its ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shape {
    /// Straight.
    Line,
    /// Circular, or a helix where the ends differ along the axis.
    Arc(Arc),
}

/// An arc about an axis. Both ends are equally far from the axis: readers refuse larger differences
/// than rounding makes and move the centre by what is left.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arc {
    /// Centre at the height of the start point (in the plane through it normal to the axis), m.
    pub centre: V3,
    /// Unit vector; the motion is right-handed about it.
    pub axis: V3,
    /// Angle swept, rad, above zero; 2π for a full circle, more for several turns.
    pub angle: f64,
}
