//! The curves that a path is made of, all by their true arc length.

use super::arc_length::{ArcLength, Parametric};
use super::bezier::{Bezier, End};
use super::nurbs::NurbsCurve;
use crate::ground::vector::{V3, add, cross, dot, norm, scale, sub, unit};
use crate::measurement::toolpath::Arc;
use std::sync::Arc as Shared;

/// A curve over its arc length.
#[derive(Debug, Clone, PartialEq)]
pub enum Curve {
    /// A straight line.
    Line(Line),
    /// A circle or helix.
    Circle(Circle),
    /// A blend.
    Blend(Box<ByLength<Bezier>>),
    /// A rational B-spline.
    Nurbs(Box<ByLength<Shared<NurbsCurve>>>),
}

/// A straight line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line {
    from: V3,
    to: V3,
    direction: V3,
    length: f64,
}

/// A circle, or a helix where it rises.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Circle {
    centre: V3,
    /// From the centre to the start, and the same a quarter turn on, m.
    spokes: [V3; 2],
    /// Rise over the whole curve, m.
    rise: V3,
    angle: f64,
    length: f64,
}

/// A parametric curve with its table of lengths.
#[derive(Debug, Clone, PartialEq)]
pub struct ByLength<C> {
    /// The curve.
    pub curve: C,
    /// Its lengths.
    pub table: ArcLength,
}

impl Parametric for Shared<NurbsCurve> {
    fn derivatives(&self, u: f64) -> [V3; 3] {
        (**self).derivatives(u)
    }

    fn velocity(&self, u: f64) -> V3 {
        (**self).velocity(u)
    }
}

impl<C: Parametric> ByLength<C> {
    /// Measures a curve that is smooth between neighbouring `breaks`.
    pub fn measured(curve: C, breaks: &[f64]) -> Self {
        let table = ArcLength::of(&curve, breaks);
        Self { curve, table }
    }

    fn end(&self, s: f64) -> End {
        let [point, v, a] = self
            .curve
            .derivatives(self.table.parameter(&self.curve, s));
        let speed = norm(v);
        let tangent = scale(1.0 / speed, v);
        let across = sub(a, scale(dot(a, tangent), tangent));
        End {
            point,
            tangent,
            curvature: scale(1.0 / (speed * speed), across),
        }
    }

    fn point(&self, s: f64) -> V3 {
        let u = self.table.parameter(&self.curve, s);
        self.curve.derivatives(u)[0]
    }
}

impl Curve {
    /// The line between two places (m); `None` where they are one.
    pub fn line(from: V3, to: V3) -> Option<Self> {
        let direction = unit(sub(to, from))?;
        let length = norm(sub(to, from));
        Some(Self::Line(Line {
            from,
            to,
            direction,
            length,
        }))
    }

    /// An arc from `from` to `to` (m); both lie on it. `None` if it has no length.
    pub fn arc(from: V3, to: V3, arc: &Arc) -> Option<Self> {
        let radius = sub(from, arc.centre);
        let rise = scale(dot(sub(to, from), arc.axis), arc.axis);
        let length = (norm(radius) * arc.angle).hypot(norm(rise));
        (length > 0.0).then_some(Self::Circle(Circle {
            centre: arc.centre,
            spokes: [radius, cross(arc.axis, radius)],
            rise,
            angle: arc.angle,
            length,
        }))
    }

    /// The blend between two ends.
    pub fn blend(from: &End, to: &End) -> Self {
        let bezier = Bezier::between(from, to);
        Self::Blend(Box::new(ByLength::measured(bezier, &[0.0, 1.0])))
    }

    /// Length, m.
    pub fn length(&self) -> f64 {
        match self {
            Self::Line(line) => line.length,
            Self::Circle(circle) => circle.length,
            Self::Blend(blend) => blend.table.total(),
            Self::Nurbs(nurbs) => nurbs.table.total(),
        }
    }

    /// Place at the length `s` (m) from the start, m.
    pub fn point(&self, s: f64) -> V3 {
        match self {
            Self::Line(line) => line.point(s),
            Self::Circle(circle) => circle.point(s),
            Self::Blend(blend) => blend.point(s),
            Self::Nurbs(nurbs) => nurbs.point(s),
        }
    }

    /// Place, direction and curvature at the length `s` (m) from the start.
    pub fn end(&self, s: f64) -> End {
        match self {
            Self::Line(line) => End {
                point: line.point(s),
                tangent: line.direction,
                curvature: [0.0; 3],
            },
            Self::Circle(circle) => circle.end(s),
            Self::Blend(blend) => blend.end(s),
            Self::Nurbs(nurbs) => nurbs.end(s),
        }
    }

    /// Whether it is straight.
    pub fn is_line(&self) -> bool {
        matches!(self, Self::Line(_))
    }
}

impl Line {
    /// From the nearer end, so that both ends are met to the last digit.
    fn point(&self, s: f64) -> V3 {
        match s < 0.5 * self.length {
            true => add(self.from, scale(s, self.direction)),
            false => add(self.to, scale(s - self.length, self.direction)),
        }
    }
}

impl Circle {
    fn point(&self, s: f64) -> V3 {
        let share = s / self.length;
        let (sin, cos) = (share * self.angle).sin_cos();
        let [first, second] = self.spokes;
        let round = add(scale(cos, first), scale(sin, second));
        add(add(self.centre, round), scale(share, self.rise))
    }

    fn end(&self, s: f64) -> End {
        let (sin, cos) = (s / self.length * self.angle).sin_cos();
        let [first, second] = self.spokes;
        let rate = self.angle / self.length;
        let around = sub(scale(cos, second), scale(sin, first));
        let outward = add(scale(cos, first), scale(sin, second));
        End {
            point: self.point(s),
            tangent: add(scale(rate, around), scale(1.0 / self.length, self.rise)),
            curvature: scale(-rate * rate, outward),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn a_helix_has_its_length_slope_and_curvature() {
        let arc = Arc {
            centre: [1.0, 0.0, 0.0],
            axis: [0.0, 0.0, 1.0],
            angle: 3.0 * PI,
        };
        let curve = Curve::arc([3.0, 0.0, 0.0], [-1.0, 0.0, 0.5], &arc).unwrap();
        let length = (6.0 * PI).hypot(0.5);
        assert!((curve.length() - length).abs() < 1e-14 * length);
        assert!(norm(sub(curve.point(length), [-1.0, 0.0, 0.5])) < 1e-14);
        let end = curve.end(0.3 * length);
        assert!((norm(end.tangent) - 1.0).abs() < 1e-15);
        let rate = 3.0 * PI / length;
        assert!((norm(end.curvature) - 2.0 * rate * rate).abs() < 1e-14);
        let h = 1e-6;
        let ahead = scale(0.5 / h, sub(curve.point(0.3 * length + h), curve.point(0.3 * length - h)));
        assert!(norm(sub(ahead, end.tangent)) < 1e-9);
    }
}
