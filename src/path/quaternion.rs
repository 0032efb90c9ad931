//! Unit quaternions: orientations between two orientations, without Euler angles.

use crate::ground::vector::{M3, V3, cross, dot, norm, of_quaternion, scale, unit};

/// A unit quaternion (w, x, y, z); q and −q are the same orientation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quaternion(pub [f64; 4]);

impl Quaternion {
    /// No rotation.
    pub const IDENTITY: Self = Self([1.0, 0.0, 0.0, 0.0]);

    /// Of a rotation matrix (columns: the turned axes), by its largest component
    /// (Shepperd 1978).
    pub fn of(m: &M3) -> Self {
        let trace = m[0][0] + m[1][1] + m[2][2];
        let squares = [
            trace,
            2.0 * m[0][0] - trace,
            2.0 * m[1][1] - trace,
            2.0 * m[2][2] - trace,
        ];
        let largest = (0..4)
            .max_by(|&i, &j| squares[i].total_cmp(&squares[j]))
            .unwrap_or(0);
        let four = 1.0 + squares[largest];
        let (yz, zx, xy) = (m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]);
        let (xs, ys, zs) = (m[1][0] + m[0][1], m[2][0] + m[0][2], m[2][1] + m[1][2]);
        let q = match largest {
            0 => [four, yz, zx, xy],
            1 => [yz, four, xs, ys],
            2 => [zx, xs, four, zs],
            _ => [xy, ys, zs, four],
        };
        Self(q).normalised()
    }

    /// Rotation by |v| (rad) about v.
    pub fn exp(v: V3) -> Self {
        let half = 0.5 * norm(v);
        let ratio = match half < 1e-8 {
            true => 0.5 - half * half / 12.0,
            false => 0.5 * half.sin() / half,
        };
        Self([half.cos(), ratio * v[0], ratio * v[1], ratio * v[2]])
    }

    /// Axis times angle (rad, at most π): the shortest rotation that this is.
    pub fn log(self) -> V3 {
        let [w, x, y, z] = self.0;
        let sin = norm([x, y, z]);
        let angle = 2.0 * sin.atan2(w.abs());
        let ratio = if sin < 1e-12 { 2.0 } else { angle / sin };
        scale(if w < 0.0 { -ratio } else { ratio }, [x, y, z])
    }

    /// The least rotation that turns the unit vector `from` into `to`: no twist about either.
    /// Opposite vectors: by half a turn about some axis across them.
    pub fn between(from: V3, to: V3) -> Self {
        let (along, across) = (dot(from, to), cross(from, to));
        if along > -1.0 + 1e-14 {
            let [x, y, z] = across;
            return Self([1.0 + along, x, y, z]).normalised();
        }
        let axis = unit(across).unwrap_or_else(|| crate::ground::vector::normals(from).0);
        Self([0.0, axis[0], axis[1], axis[2]])
    }

    /// self ∘ inner: the inner rotation first.
    pub fn times(self, inner: Self) -> Self {
        let ([a, b, c, d], [e, f, g, h]) = (self.0, inner.0);
        Self([
            a * e - b * f - c * g - d * h,
            a * f + b * e + c * h - d * g,
            a * g - b * h + c * e + d * f,
            a * h + b * g - c * f + d * e,
        ])
    }

    /// The rotation back.
    pub fn inverse(self) -> Self {
        let [w, x, y, z] = self.0;
        Self([w, -x, -y, -z])
    }

    /// Rotation vector in own axes that leads from here to `to`, the short way, rad.
    pub fn way_to(self, to: Self) -> V3 {
        self.inverse().times(to).log()
    }

    /// This orientation, turned by the rotation vector `v` (rad) given in own axes.
    pub fn turned(self, v: V3) -> Self {
        self.times(Self::exp(v))
    }

    /// The matrix: columns are the turned axes.
    pub fn matrix(self) -> M3 {
        of_quaternion(self.0)
    }

    /// Length one again.
    #[must_use]
    pub fn normalised(self) -> Self {
        let size = self.0.iter().map(|x| x * x).sum::<f64>().sqrt();
        Self(self.0.map(|x| x / size))
    }
}

/// Angles a, b, c (rad) of a rotation matrix, `R = Rz(a) Ry(b) Rx(c)`; where b is ±90 degrees only
/// one of a and c is fixed: c is then zero.
pub fn angles(m: &M3) -> [f64; 3] {
    let level = m[0][0].hypot(m[1][0]);
    let b = (-m[2][0]).atan2(level);
    match level > 1e-12 {
        true => [m[1][0].atan2(m[0][0]), b, m[2][1].atan2(m[2][2])],
        false => [(-m[0][1]).atan2(m[1][1]), b, 0.0],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ground::random::Random;
    use crate::ground::vector::{product, roll_pitch_yaw, rotate, rotation, sub, transpose};

    fn apart(a: &M3, b: &M3) -> f64 {
        norm(crate::ground::vector::rotation_vector(&product(
            &transpose(a),
            b,
        )))
    }

    #[test]
    fn matrices_and_angles_come_back_from_any_orientation() {
        let mut random = Random::new(3);
        for i in 0..2000 {
            let pitch = match i % 4 {
                0 => 0.5 * std::f64::consts::PI,
                1 => -0.5 * std::f64::consts::PI,
                _ => random.uniform(-1.5, 1.5),
            };
            let m = roll_pitch_yaw(random.uniform(-3.1, 3.1), pitch, random.uniform(-3.1, 3.1));
            assert!(apart(&Quaternion::of(&m).matrix(), &m) < 1e-14);
            let [a, b, c] = angles(&m);
            assert!(apart(&roll_pitch_yaw(c, b, a), &m) < 1e-9, "{m:?}");
        }
    }

    #[test]
    fn a_way_is_short_and_its_half_lies_in_the_middle() {
        let from = Quaternion::of(&rotation(unit([1.0, 2.0, 0.3]).unwrap(), 0.4));
        let axis = unit([0.2, -1.0, 0.5]).unwrap();
        for angle in [1e-11, 0.3, 3.0, 6.0] {
            let to = from.turned(scale(angle, axis));
            let way = from.way_to(to);
            let short = if angle > std::f64::consts::PI {
                angle - std::f64::consts::TAU
            } else {
                angle
            };
            assert!(norm(sub(way, scale(short, axis))) < 1e-14);
        }
    }

    #[test]
    fn least_rotations_have_no_part_about_the_vectors() {
        let mut random = Random::new(5);
        let mut direction = || {
            unit([
                random.uniform(-1.0, 1.0),
                random.uniform(-1.0, 1.0),
                random.uniform(-1.0, 1.0),
            ])
            .unwrap()
        };
        for _ in 0..200 {
            let (a, b) = (direction(), direction());
            let q = Quaternion::between(a, b);
            assert!(norm(sub(rotate(&q.matrix(), a), b)) < 1e-14);
            assert!(dot(q.log(), a).abs() < 1e-13 && dot(q.log(), b).abs() < 1e-13);
            let half = Quaternion::between(a, scale(-1.0, a));
            assert!(norm(sub(rotate(&half.matrix(), a), scale(-1.0, a))) < 1e-14);
        }
    }
}
