//! Quintic Bézier blends with given tangents and curvatures at both ends.

use super::arc_length::Parametric;
use crate::ground::vector::{V3, add, dot, scale, sub};

/// An end of a blend.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct End {
    /// Place, m.
    pub point: V3,
    /// Unit vector of travel.
    pub tangent: V3,
    /// Change of the tangent with the arc length, 1/m; zero on a line.
    pub curvature: V3,
}

/// A Bézier curve of degree five (source 000, eqs. 4.7 and 4.8) as a polynomial.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bezier {
    start: V3,
    /// Coefficients of u¹ to u⁵, m.
    powers: [V3; 5],
}

impl Bezier {
    /// The blend between two ends: first derivatives α·tangent and second ones α²·curvature, so that
    /// tangent and curvature run on (C² over the arc length). α is chosen as if the ends were
    /// straight, so that the speed by the parameter is α at both ends and in the middle: then the
    /// curve bends as evenly as it can (Biagiotti & Melchiorri 2009, section 8.8).
    pub fn between(from: &End, to: &End) -> Self {
        let chord = sub(to.point, from.point);
        let sum = add(from.tangent, to.tangent);
        let (a, b, c) = (
            256.0 - 49.0 * dot(sum, sum),
            420.0 * dot(chord, sum),
            900.0 * dot(chord, chord),
        );
        let alpha = 2.0 * c / (b + (b * b + 4.0 * a * c).sqrt());
        let (first, last) = (scale(alpha, from.tangent), scale(alpha, to.tangent));
        let bend = |end: &End| scale(alpha * alpha, end.curvature);
        Self::hermite(from.point, chord, [first, last], [bend(from), bend(to)])
    }

    /// The quintic with these derivatives (first, second) at its two ends.
    fn hermite(start: V3, chord: V3, [v0, v1]: [V3; 2], [a0, a1]: [V3; 2]) -> Self {
        let mut powers = [[0.0; 3]; 5];
        for i in 0..3 {
            let (d, half) = (chord[i] - v0[i] - 0.5 * a0[i], 0.5 * (a1[i] - a0[i]));
            let slope = v1[i] - v0[i] - a0[i];
            powers[0][i] = v0[i];
            powers[1][i] = 0.5 * a0[i];
            powers[2][i] = 10.0 * d - 4.0 * slope + half;
            powers[3][i] = -15.0 * d + 7.0 * slope - 2.0 * half;
            powers[4][i] = 6.0 * d - 3.0 * slope + half;
        }
        Self { start, powers }
    }
}

impl Parametric for Bezier {
    fn derivatives(&self, u: f64) -> [V3; 3] {
        let [a, b, c, d, e] = &self.powers;
        let at = |i: usize| {
            self.start[i] + u * (a[i] + u * (b[i] + u * (c[i] + u * (d[i] + u * e[i]))))
        };
        let bend = |i: usize| 2.0 * b[i] + u * (6.0 * c[i] + u * (12.0 * d[i] + u * 20.0 * e[i]));
        [
            [at(0), at(1), at(2)],
            self.velocity(u),
            [bend(0), bend(1), bend(2)],
        ]
    }

    fn velocity(&self, u: f64) -> V3 {
        let [a, b, c, d, e] = &self.powers;
        let one = |i: usize| {
            a[i] + u * (2.0 * b[i] + u * (3.0 * c[i] + u * (4.0 * d[i] + u * 5.0 * e[i])))
        };
        [one(0), one(1), one(2)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ground::vector::norm;

    fn straight(point: V3, tangent: V3) -> End {
        End {
            point,
            tangent,
            curvature: [0.0; 3],
        }
    }

    /// Bernstein's form with the control points that the conditions ask for.
    fn bernstein(p: &[V3; 6], u: f64) -> V3 {
        let binomial = [1.0, 5.0, 10.0, 10.0, 5.0, 1.0];
        (0..6).fold([0.0; 3], |sum, j| {
            let weight = binomial[j] * u.powi(j as i32) * (1.0 - u).powi(5 - j as i32);
            add(sum, scale(weight, p[j]))
        })
    }

    #[test]
    fn a_right_angle_is_the_bezier_curve_of_its_control_points() {
        let blend = Bezier::between(
            &straight([-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]),
            &straight([0.0, 1.0, 0.0], [0.0, 1.0, 0.0]),
        );
        // 158 α² + 840 α − 1800 = 0.
        let alpha = (-840.0 + (840.0_f64 * 840.0 + 4.0 * 158.0 * 1800.0).sqrt()) / 316.0;
        let k = alpha / 5.0;
        let control = [
            [-1.0, 0.0, 0.0],
            [-1.0 + k, 0.0, 0.0],
            [-1.0 + 2.0 * k, 0.0, 0.0],
            [0.0, 1.0 - 2.0 * k, 0.0],
            [0.0, 1.0 - k, 0.0],
            [0.0, 1.0, 0.0],
        ];
        for u in [0.0, 0.1, 0.37, 0.5, 0.9, 1.0] {
            let gap = sub(blend.derivatives(u)[0], bernstein(&control, u));
            assert!(norm(gap) < 1e-15, "{u}");
        }
        for u in [0.0, 0.5, 1.0] {
            assert!((norm(blend.velocity(u)) - alpha).abs() < 1e-14);
        }
        let [.., first] = blend.derivatives(0.0);
        let [.., last] = blend.derivatives(1.0);
        assert!(norm(first) < 1e-15 && norm(last) < 1e-13);
    }

    #[test]
    fn a_straight_blend_is_uniform_and_an_end_on_a_circle_has_its_curvature() {
        let line = Bezier::between(
            &straight([0.0; 3], [1.0, 0.0, 0.0]),
            &straight([2.0, 0.0, 0.0], [1.0, 0.0, 0.0]),
        );
        assert!(norm(sub(line.derivatives(0.3)[0], [0.6, 0.0, 0.0])) < 1e-15);
        let circle = End {
            point: [2.0, 1.0, 0.0],
            tangent: [0.0, 1.0, 0.0],
            curvature: [-0.5, 0.0, 0.0],
        };
        let blend = Bezier::between(&straight([0.0; 3], [1.0, 0.0, 0.0]), &circle);
        let [_, v, a] = blend.derivatives(1.0);
        let speed = norm(v);
        let across = sub(a, scale(dot(a, v) / (speed * speed), v));
        let curvature = scale(1.0 / (speed * speed), across);
        assert!(norm(sub(curvature, circle.curvature)) < 1e-12);
    }
}
