//! Rotations in a plane as points of the unit circle: composed and applied without an angle.

use crate::ground::arctangent::arctangent;
use crate::ground::vector::V3;

/// Cosine and sine.
pub type Circle = [f64; 2];

/// Cosine and sine of an angle (rad).
pub fn circle(angle: f64) -> Circle {
    let (sin, cos) = angle.sin_cos();
    [cos, sin]
}

/// The angle of a direction in the plane, rad.
pub fn angle([cos, sin]: Circle) -> f64 {
    arctangent(sin, cos)
}

/// The rotation that turns the direction `from` into `to`, times both lengths.
#[inline(always)]
pub fn between(from: Circle, to: Circle) -> Circle {
    [
        from[0] * to[0] + from[1] * to[1],
        from[0] * to[1] - from[1] * to[0],
    ]
}

/// Both rotations one after the other.
#[inline(always)]
pub fn together(a: Circle, b: Circle) -> Circle {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

/// The vector turned back about the third axis.
#[inline(always)]
pub fn turned_back([x, y, z]: V3, [cos, sin]: Circle) -> V3 {
    [cos * x + sin * y, cos * y - sin * x, z]
}
