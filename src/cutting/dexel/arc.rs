//! Which part of a circle about the tool a place takes away at which the tool stood a little before.

use super::frame::Frame;
use super::solid::Solid;
use crate::ground::spatial::{V3, dot, norm, sub};

/// What the tool has cut on its latest way is seen where it is deeper than this, m.
pub(super) const TOUCH: f64 = 1e-9;
/// Axes that differ by less are one.
const TURNED: f64 = 1e-9;

/// The part of a circle that lies in an earlier place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Arc {
    /// Nothing of it.
    None,
    /// Where sin φ·x + cos φ·y < `below`, the place standing upright in the frame.
    Below { x: f64, y: f64, below: f64 },
    /// The place is tilted against the frame: every point for itself.
    Tilted,
}

impl Arc {
    /// The part of the circle of `radius` m about `centre` (workpiece frame, m), across the frame's axis.
    ///
    /// A point at φ is |r n + d|² = r² + 2 r n·d + d² from the axis of the place, d from there to the centre.
    pub fn of(solid: &Solid, frame: &Frame, centre: V3, radius: f64) -> Self {
        if norm(sub(solid.axis, frame.z)) > TURNED || radius <= 0.0 {
            return Self::Tilted;
        }
        let from = sub(centre, solid.tip);
        let Some(reach) = solid.reach(dot(from, frame.z), TOUCH) else {
            return Self::None;
        };
        let (x, y) = (dot(from, frame.x), dot(from, frame.y));
        let below = 0.5 * ((reach * reach - x * x - y * y) / radius - radius);
        Self::Below { x, y, below }
    }
}

/// Whether the point at `direction` ([sin φ, cos φ]) of a circle lies in one of the places.
#[inline]
pub(super) fn taken(arcs: &[Arc], places: &[Solid], direction: [f64; 2], point: V3) -> bool {
    let [sin, cos] = direction;
    arcs.iter().zip(places).any(|(arc, place)| match arc {
        Arc::None => false,
        Arc::Below { x, y, below } => sin * x + cos * y < *below,
        Arc::Tilted => place.holds(point, TOUCH),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ground::spatial::{add, scale};

    #[test]
    fn a_part_of_a_circle_is_what_the_place_holds() {
        let frame = Frame::towards([1.0, 0.2, 0.0], [0.0, 0.0, 1.0]);
        let places = [0.0, 2.0, 5.0].map(|corner| Solid {
            radius: 5e-3,
            corner: corner * 1e-3,
            length: 0.02,
            tip: [0.3e-3, -0.2e-3, 0.1e-3],
            axis: frame.z,
        });
        for (i, place) in places.iter().enumerate() {
            for height in [0.0, 1e-3, 4e-3, 0.03] {
                let centre = [0.0, 0.0, height];
                let arc = Arc::of(place, &frame, centre, 4.9e-3);
                for k in 0..360 {
                    let (sin, cos) = f64::from(k).to_radians().sin_cos();
                    let point = add(centre, scale(4.9e-3, frame.outward([sin, cos])));
                    let told = taken(&[arc], &[*place], [sin, cos], point);
                    assert_eq!(told, place.holds(point, TOUCH), "{i} {height} {k}");
                }
            }
        }
    }
}
