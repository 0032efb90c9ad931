//! Non-uniform rational B-splines by de Boor's algorithm, with exact derivatives.

use super::arc_length::Parametric;
use super::quaternion::Quaternion;
use crate::ground::vector::{V3, scale, sub};

/// A B-spline of vectors with N components.
#[derive(Debug, Clone, PartialEq)]
struct Spline<const N: usize> {
    degree: usize,
    knots: Vec<f64>,
    points: Vec<[f64; N]>,
}

impl<const N: usize> Spline<N> {
    /// de Boor 1972: repeated linear interpolation between the points that act at `u`.
    fn at(&self, u: f64) -> [f64; N] {
        let (p, last) = (self.degree, self.points.len() - 1);
        let after = self.knots.partition_point(|knot| *knot <= u);
        let mut span = after.saturating_sub(1).clamp(p, last);
        while span > p && self.knots[span] >= self.knots[span + 1] {
            span -= 1;
        }
        let mut d = self.points[span - p..=span].to_vec();
        for level in 1..=p {
            for j in (level..=p).rev() {
                let i = j + span - p;
                let (low, high) = (self.knots[i], self.knots[i + 1 + p - level]);
                let share = (u - low) / (high - low);
                let before = d[j - 1];
                d[j].iter_mut()
                    .zip(before)
                    .for_each(|(x, y)| *x = share * *x + (1.0 - share) * y);
            }
        }
        d[p]
    }

    /// The derivative: a spline of one degree less (Piegl & Tiller 1997, eq. 3.8).
    fn derivative(&self) -> Self {
        if self.degree == 0 {
            let points = vec![[0.0; N]; self.points.len()];
            return Self { points, ..self.clone() };
        }
        let p = self.degree;
        let leg = |i: usize| {
            let wide = self.knots[i + p + 1] - self.knots[i + 1];
            let factor = if wide > 0.0 { p as f64 / wide } else { 0.0 };
            let mut out = self.points[i + 1];
            out.iter_mut()
                .zip(self.points[i])
                .for_each(|(x, y)| *x = factor * (*x - y));
            out
        };
        Self {
            degree: p - 1,
            knots: self.knots[1..self.knots.len() - 1].to_vec(),
            points: (0..self.points.len() - 1).map(leg).collect(),
        }
    }
}

/// A rational B-spline curve with orientations along it.
#[derive(Debug, Clone, PartialEq)]
pub struct NurbsCurve {
    /// Weighted points (w x, w y, w z, w) and their first two derivatives.
    homogeneous: [Spline<4>; 3],
    /// Weighted quaternions over the same basis.
    turns: Spline<4>,
}

impl NurbsCurve {
    /// Of control points (m), weights above zero and orientations, one each, and
    /// `points.len() + degree + 1` knots that do not decrease. The orientation at a parameter is the
    /// weighted mean of the quaternions by the same rational basis, made a unit again.
    pub fn new(
        degree: usize,
        knots: &[f64],
        points: &[V3],
        weights: &[f64],
        turns: &[Quaternion],
    ) -> Self {
        let weighted = points.iter().zip(weights);
        let points = weighted.map(|(p, w)| [w * p[0], w * p[1], w * p[2], *w]);
        let spline = |points: Vec<[f64; 4]>| Spline {
            degree,
            knots: knots.to_vec(),
            points,
        };
        let place = spline(points.collect());
        let speed = place.derivative();
        let change = speed.derivative();
        let turns = near_each_other(turns).into_iter().zip(weights);
        Self {
            homogeneous: [place, speed, change],
            turns: spline(turns.map(|(q, w)| q.map(|x| w * x)).collect()),
        }
    }

    /// Orientation at a parameter.
    pub fn orientation(&self, u: f64) -> Quaternion {
        Quaternion(self.turns.at(u)).normalised()
    }

    /// The parameters where the curve begins, has its inner knots, and ends; increasing.
    pub fn breaks(&self) -> Vec<f64> {
        let spline = &self.homogeneous[0];
        let mut breaks = spline.knots[spline.degree..=spline.points.len()].to_vec();
        breaks.dedup();
        breaks
    }

    /// Whether the curve may have a corner at the inner knot `u`: it stands there as often as the
    /// degree says.
    pub fn may_bend_at(&self, u: f64) -> bool {
        let spline = &self.homogeneous[0];
        let times = spline.knots.iter().filter(|knot| **knot == u).count();
        times >= spline.degree
    }
}

impl Parametric for NurbsCurve {
    fn derivatives(&self, u: f64) -> [V3; 3] {
        let [a, b, c] = [0, 1, 2].map(|k| self.homogeneous[k].at(u));
        let (w, w1, w2) = (a[3], b[3], c[3]);
        let part = |h: [f64; 4]| [h[0], h[1], h[2]];
        let place = scale(1.0 / w, part(a));
        let first = scale(1.0 / w, sub(part(b), scale(w1, place)));
        let rest = sub(part(c), scale(2.0 * w1, first));
        [
            place,
            first,
            scale(1.0 / w, sub(rest, scale(w2, place))),
        ]
    }

    fn velocity(&self, u: f64) -> V3 {
        let [a, b] = [0, 1].map(|k| self.homogeneous[k].at(u));
        [0, 1, 2].map(|i| (b[i] - b[3] * a[i] / a[3]) / a[3])
    }
}

/// The same orientations with signs such that neighbours lie on one side.
fn near_each_other(turns: &[Quaternion]) -> Vec<[f64; 4]> {
    let mut signed: Vec<[f64; 4]> = Vec::with_capacity(turns.len());
    for turn in turns {
        let along = |last: &[f64; 4]| last.iter().zip(turn.0).map(|(a, b)| a * b).sum::<f64>();
        let sign = signed.last().map_or(1.0, |last| along(last).signum());
        signed.push(turn.0.map(|x| sign * x));
    }
    signed
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ground::vector::norm;
    use crate::path::arc_length::ArcLength;
    use std::f64::consts::{FRAC_1_SQRT_2, TAU};

    fn circle() -> NurbsCurve {
        let r = FRAC_1_SQRT_2;
        let corners = [
            [1.0, 0.0],
            [1.0, 1.0],
            [0.0, 1.0],
            [-1.0, 1.0],
            [-1.0, 0.0],
            [-1.0, -1.0],
            [0.0, -1.0],
            [1.0, -1.0],
            [1.0, 0.0],
        ];
        let points = corners.map(|[x, y]| [x, y, 0.0]);
        let weights = [1.0, r, 1.0, r, 1.0, r, 1.0, r, 1.0];
        let knots = [
            0.0, 0.0, 0.0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1.0, 1.0, 1.0,
        ];
        NurbsCurve::new(2, &knots, &points, &weights, &[Quaternion::IDENTITY; 9])
    }

    #[test]
    fn nine_points_make_a_circle_with_its_arc_length() {
        let curve = circle();
        for i in 0..=400 {
            let [p, v, a] = curve.derivatives(f64::from(i) / 400.0);
            assert!((norm(p) - 1.0).abs() < 1e-15 * 4.0);
            let cross = v[0] * a[1] - v[1] * a[0];
            assert!((cross / norm(v).powi(3) - 1.0).abs() < 1e-12);
        }
        let [p, ..] = curve.derivatives(0.125);
        assert!(norm(sub(p, [0.5_f64.sqrt(), 0.5_f64.sqrt(), 0.0])) < 1e-15);
        let [p, ..] = curve.derivatives(0.0625);
        assert!(norm(sub(p, [0.929_788_3, 0.368_094_71, 0.0])) < 1e-7);
        let table = ArcLength::of(&curve, &curve.breaks());
        assert!((table.total() / TAU - 1.0).abs() < 1e-14);
        for i in 0..100 {
            let s = f64::from(i) / 100.0 * TAU;
            let [p, ..] = curve.derivatives(table.parameter(&curve, s));
            assert!(norm(sub(p, [s.cos(), s.sin(), 0.0])) < 1e-12, "{s}");
        }
    }

    #[test]
    fn derivatives_are_those_of_differences() {
        let points = [[0.0, 0.0, 0.0], [1.0, 2.0, 0.5], [3.0, -1.0, 1.0], [4.0, 0.0, 2.0], [5.0, 3.0, 0.0]];
        let knots = [0.0, 0.0, 0.0, 0.0, 0.4, 1.0, 1.0, 1.0, 1.0];
        let weights = [1.0, 2.0, 0.7, 1.5, 1.0];
        let curve = NurbsCurve::new(3, &knots, &points, &weights, &[Quaternion::IDENTITY; 5]);
        for u in [0.1, 0.39, 0.4, 0.77, 0.99] {
            let h = 1e-5;
            let [before, after] = [curve.derivatives(u - h)[0], curve.derivatives(u + h)[0]];
            let [p, v, a] = curve.derivatives(u);
            for i in 0..3 {
                assert!(((after[i] - before[i]) / (2.0 * h) - v[i]).abs() < 1e-7);
                if u != 0.4 {
                    assert!(((after[i] - 2.0 * p[i] + before[i]) / (h * h) - a[i]).abs() < 1e-3);
                }
                assert!((curve.velocity(u)[i] - v[i]).abs() < 1e-13);
            }
        }
        assert_eq!(curve.derivatives(0.0)[0], points[0]);
        assert_eq!(curve.derivatives(1.0)[0], points[4]);
    }
}
