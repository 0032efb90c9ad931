//! The two shapes of a move.

use super::draft::within;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::vector::{M3, V3, add, cross, dot, norm, rotate, rotation, scale, sub, unit};
use std::f64::consts::{PI, TAU};

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

/// Ends closer than this make a full circle, m.
const CLOSED: f64 = 2e-6;
/// Smallest angle of an arc, rad.
const FLAT: f64 = 1e-12;

/// Difference of radii that rounding to hundredths of a millimetre makes, m.
fn rounding(radius: f64) -> f64 {
    2e-5 + (1e-5 * radius).min(8e-5)
}

impl Arc {
    /// The arc from one point to another about an axis (a unit vector) through `centre`, with whole
    /// `turns` more. Ends that coincide make a full circle.
    ///
    /// # Errors
    /// Ends that are not equally far from the centre; a centre kilometres away.
    pub fn about(from: V3, to: V3, centre: V3, axis: V3, turns: usize) -> Outcome<Self> {
        within(centre)?;
        let flat = |v: V3| sub(v, scale(dot(v, axis), axis));
        let (start, end) = (flat(sub(from, centre)), flat(sub(to, centre)));
        let (first, last) = (norm(start), norm(end));
        let (apart, chord) = ((first - last).abs(), sub(end, start));
        let closed = norm(chord) < CLOSED;
        let allowed = rounding(first.max(last));
        let radial = !closed && norm(chord) < 4.0 * apart;
        if apart > allowed || first.min(last) < CLOSED || radial {
            return Err(off_circle(first, last));
        }
        let shift = match closed {
            true => [0.0; 3],
            false => scale(0.5 * dot(add(start, end), chord) / dot(chord, chord), chord),
        };
        let (start, end) = (sub(start, shift), sub(end, shift));
        let swept = match closed {
            true => TAU,
            false => dot(axis, cross(start, end))
                .atan2(dot(start, end))
                .rem_euclid(TAU),
        };
        if swept < FLAT || (swept > PI && norm(shift) > 2.0 * allowed) {
            return Err(off_circle(first, last));
        }
        let height = scale(dot(sub(from, centre), axis), axis);
        Ok(Self {
            centre: add(add(centre, height), shift),
            axis,
            angle: swept + turns as f64 * TAU,
        })
    }

    /// The arc from one point through another to a third.
    ///
    /// # Errors
    /// Three points on one line.
    pub fn through(from: V3, middle: V3, to: V3) -> Outcome<Self> {
        let (a, b) = (sub(middle, from), sub(to, from));
        let normal = cross(a, b);
        let area = dot(normal, normal);
        let flat = area <= 1e-16 * dot(a, a) * dot(b, b);
        let axis = unit(normal).filter(|_| !flat).ok_or_else(|| {
            let remedy = "give three points that are apart and not in line, or write a line";
            Problem::new("the three points make no circle", remedy)
        })?;
        let offset = cross(sub(scale(dot(a, a), b), scale(dot(b, b), a)), normal);
        let centre = add(from, scale(0.5 / area, offset));
        Self::about(from, to, centre, axis, 0)
    }

    /// The point of the circle at an angle (rad) from the point `from`, in the plane of `from`.
    pub fn at(&self, from: V3, angle: f64) -> V3 {
        let turned: M3 = rotation(self.axis, angle);
        add(self.centre, rotate(&turned, sub(from, self.centre)))
    }

    /// Where it turns back along x, y or z, in the plane of `from`: with its ends, its extent.
    pub fn turning_points(&self, from: V3) -> Vec<V3> {
        let start = sub(from, self.centre);
        let ahead = cross(self.axis, start);
        let angles = (0..3).flat_map(|k| {
            let first = ahead[k].atan2(start[k]).rem_euclid(PI);
            [first, first + PI]
        });
        let met = angles.filter(|angle| *angle < self.angle);
        met.map(|angle| self.at(from, angle)).collect()
    }

    /// Its radius, m, where it starts at `from`.
    pub fn radius(&self, from: V3) -> f64 {
        norm(sub(from, self.centre))
    }
}

fn off_circle(first: f64, last: f64) -> Problem {
    let what = format!(
        "the ends of the arc are {:.4} mm and {:.4} mm from its centre",
        first * 1e3,
        last * 1e3
    );
    Problem::new(
        what,
        "correct the centre or the end point; write more decimals",
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    const Z: V3 = [0.0, 0.0, 1.0];

    #[test]
    fn arcs_sweep_right_handed_and_close_to_full_circles() {
        let quarter = Arc::about([1.0, 0.0, 0.0], [0.0, 1.0, 0.5], [0.0; 3], Z, 0).unwrap();
        assert!((quarter.angle - 0.25 * TAU).abs() < 1e-15);
        let other = Arc::about(
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0; 3],
            scale(-1.0, Z),
            1,
        );
        assert!((other.unwrap().angle - 1.75 * TAU).abs() < 1e-14);
        let full = Arc::about([1.0, 0.0, 3.0], [1.0, 0.0, 3.0], [0.0; 3], Z, 0).unwrap();
        assert_eq!((full.angle, full.centre), (TAU, [0.0, 0.0, 3.0]));
    }

    #[test]
    fn rounded_centres_are_moved_and_wrong_ones_refused() {
        let to = [0.0, 0.100_004, 0.0];
        let arc = Arc::about([0.1, 0.0, 0.0], to, [0.0; 3], Z, 0).unwrap();
        assert!((norm(sub(to, arc.centre)) - arc.radius([0.1, 0.0, 0.0])).abs() < 1e-15);
        assert!(Arc::about([0.1, 0.0, 0.0], [0.0, 0.101, 0.0], [0.0; 3], Z, 0).is_err());
    }

    #[test]
    fn three_points_make_the_circle_they_lie_on() {
        let on = |t: f64| [3.0 + 2.0 * t.cos(), -1.0 + 2.0 * t.sin(), 0.5];
        let arc = Arc::through(on(0.3), on(1.0), on(4.0)).unwrap();
        assert!(norm(sub(arc.centre, [3.0, -1.0, 0.5])) < 1e-14, "{arc:?}");
        assert!((arc.angle - 3.7).abs() < 1e-13 && arc.axis[2] > 0.999);
        assert!(norm(sub(arc.at(on(0.3), 3.7), on(4.0))) < 1e-14);
        let back = Arc::through(on(4.0), on(1.0), on(0.3)).unwrap();
        assert!((back.angle - 3.7).abs() < 1e-13 && back.axis[2] < -0.999);
        assert!(Arc::through([0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]).is_err());
    }
}
