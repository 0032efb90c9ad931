//! Vectors and 3×3 matrices in space over any [`Scalar`], fixed-size, without heap.

use super::dual::Scalar;

/// A vector in space.
pub type V3<S = f64> = [S; 3];
/// A 3×3 matrix, by rows.
pub type M3<S = f64> = [[S; 3]; 3];

/// The unit matrix.
pub const IDENTITY: M3 = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Angle between two vectors, rad.
pub fn angle(a: V3, b: V3) -> f64 {
    norm(cross(a, b)).atan2(dot(a, b))
}

/// A constant vector.
#[inline(always)]
pub fn lift<S: Scalar>(v: V3) -> V3<S> {
    [S::constant(v[0]), S::constant(v[1]), S::constant(v[2])]
}
/// A constant matrix.
#[inline(always)]
pub fn lift_matrix<S: Scalar>(m: M3) -> M3<S> {
    [lift(m[0]), lift(m[1]), lift(m[2])]
}
/// a + b
#[inline(always)]
pub fn add<S: Scalar>(a: V3<S>, b: V3<S>) -> V3<S> {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}
/// a − b
#[inline(always)]
pub fn sub<S: Scalar>(a: V3<S>, b: V3<S>) -> V3<S> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}
/// k a
#[inline(always)]
pub fn scale<S: Scalar>(k: S, a: V3<S>) -> V3<S> {
    [a[0] * k, a[1] * k, a[2] * k]
}
/// a · b
#[inline(always)]
pub fn dot<S: Scalar>(a: V3<S>, b: V3<S>) -> S {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
/// a × b
#[inline(always)]
pub fn cross<S: Scalar>(a: V3<S>, b: V3<S>) -> V3<S> {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}
/// |a|
#[inline(always)]
pub fn norm<S: Scalar>(a: V3<S>) -> S {
    dot(a, a).sqrt()
}
/// a / |a|, or `None` for a vector that is zero or not finite.
pub fn unit(a: V3) -> Option<V3> {
    let n = norm(a);
    (n > 1e-300 && n.is_finite()).then(|| scale(1.0 / n, a))
}
/// m v
#[inline(always)]
pub fn rotate<S: Scalar>(m: &M3<S>, v: V3<S>) -> V3<S> {
    [dot(m[0], v), dot(m[1], v), dot(m[2], v)]
}
/// m v with a constant v: derivatives of v are known to be zero.
#[inline(always)]
pub fn rotate_constant<S: Scalar>(m: &M3<S>, v: V3) -> V3<S> {
    let row = |r: V3<S>| r[0] * v[0] + r[1] * v[1] + r[2] * v[2];
    [row(m[0]), row(m[1]), row(m[2])]
}
/// mᵀ v
#[inline(always)]
pub fn rotate_back<S: Scalar>(m: &M3<S>, v: V3<S>) -> V3<S> {
    let column = |j: usize| m[0][j] * v[0] + m[1][j] * v[1] + m[2][j] * v[2];
    [column(0), column(1), column(2)]
}
/// mᵀ
#[inline(always)]
pub fn transpose<S: Scalar>(m: &M3<S>) -> M3<S> {
    let column = |j: usize| [m[0][j], m[1][j], m[2][j]];
    [column(0), column(1), column(2)]
}
/// a b
#[inline(always)]
pub fn product<S: Scalar>(a: &M3<S>, b: &M3<S>) -> M3<S> {
    [
        rotate_back(b, a[0]),
        rotate_back(b, a[1]),
        rotate_back(b, a[2]),
    ]
}
/// Determinant.
pub fn determinant(m: &M3) -> f64 {
    dot(m[0], cross(m[1], m[2]))
}

/// R·Rot(u, angle) from sine and cosine of the angle (Rodrigues), u a constant unit vector.
/// Row by row: r′ = c r + s (r × u) + (1 − c)(r·u) u.
#[inline(always)]
pub fn turn<S: Scalar>(r: &M3<S>, u: V3, (sin, cos): (S, S)) -> M3<S> {
    let rest = -cos + 1.0;
    let row = |row: V3<S>| {
        let along = (row[0] * u[0] + row[1] * u[1] + row[2] * u[2]) * rest;
        [
            cos * row[0] + sin * (row[1] * u[2] - row[2] * u[1]) + along * u[0],
            cos * row[1] + sin * (row[2] * u[0] - row[0] * u[2]) + along * u[1],
            cos * row[2] + sin * (row[0] * u[1] - row[1] * u[0]) + along * u[2],
        ]
    };
    [row(r[0]), row(r[1]), row(r[2])]
}

/// Rot(u, angle): rotation about the unit vector u.
pub fn rotation<S: Scalar>(u: V3, angle: S) -> M3<S> {
    turn(&lift_matrix(IDENTITY), u, (angle.sin(), angle.cos()))
}

/// Rotation by a unit quaternion w, x, y, z: columns are the turned axes.
pub fn of_quaternion([w, x, y, z]: [f64; 4]) -> M3 {
    [
        [
            1.0 - 2.0 * (y * y + z * z),
            2.0 * (x * y - w * z),
            2.0 * (x * z + w * y),
        ],
        [
            2.0 * (x * y + w * z),
            1.0 - 2.0 * (x * x + z * z),
            2.0 * (y * z - w * x),
        ],
        [
            2.0 * (x * z - w * y),
            2.0 * (y * z + w * x),
            1.0 - 2.0 * (x * x + y * y),
        ],
    ]
}

/// Rz(yaw) Ry(pitch) Rx(roll), rad: the `rpy` of URDF; KUKA's A, B, C are yaw, pitch, roll.
pub fn roll_pitch_yaw(roll: f64, pitch: f64, yaw: f64) -> M3 {
    let (x, y, z) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
    let yawed: M3 = rotation(z, yaw);
    turn(&turn(&yawed, y, pitch.sin_cos()), x, roll.sin_cos())
}

/// Rotation vector (axis times angle, rad) of a rotation matrix; angle in [0, π].
pub fn rotation_vector(r: &M3) -> V3 {
    let half_axis = [r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1]];
    let (sin, cos) = (
        0.5 * norm(half_axis),
        0.5 * (r[0][0] + r[1][1] + r[2][2] - 1.0),
    );
    let angle = sin.atan2(cos);
    if sin > 1e-9 {
        return scale(0.5 * angle / sin, half_axis);
    }
    if cos > 0.0 {
        return scale(0.5, half_axis);
    }
    scale(angle, half_turn_axis(r))
}

/// Axis of a rotation by π: the largest column of (R + 1)/2.
fn half_turn_axis(r: &M3) -> V3 {
    let columns = [0, 1, 2].map(|j| [0, 1, 2].map(|i| r[i][j] + IDENTITY[i][j]));
    let longest = columns
        .into_iter()
        .max_by(|a, b| norm(*a).total_cmp(&norm(*b)));
    longest.and_then(unit).unwrap_or([1.0, 0.0, 0.0])
}

/// Two unit vectors that make a right-handed frame (first, second, u) with the unit vector u. They turn smoothly with u but
/// where a component passes through ±0.59, so never near an axis of the frame: a difference there is a slope.
pub fn normals(u: V3) -> (V3, V3) {
    // of three components that make one, the least is at most 0.58; 0.6 is one of every direction 3:4:5
    let across = u.iter().position(|x| x.abs() < 0.59).unwrap_or(0);
    let mut helper = [0.0; 3];
    helper[across] = 1.0;
    let first = unit(sub(helper, scale(dot(helper, u), u))).unwrap_or([1.0, 0.0, 0.0]);
    (first, cross(u, first))
}

/// Symmetric matrix (xx yy zz xy xz yz) times vector.
#[inline(always)]
pub fn symmetric<S: Scalar>(t: &[S; 6], v: V3<S>) -> V3<S> {
    [
        t[0] * v[0] + t[3] * v[1] + t[4] * v[2],
        t[3] * v[0] + t[1] * v[1] + t[5] * v[2],
        t[4] * v[0] + t[5] * v[1] + t[2] * v[2],
    ]
}

/// R T Rᵀ of a constant symmetric T (xx yy zz xy xz yz).
#[inline(always)]
pub fn rotate_tensor<S: Scalar>(r: &M3<S>, t: &[f64; 6]) -> [S; 6] {
    let along = |row: V3<S>, x: f64, y: f64, z: f64| row[0] * x + row[1] * y + row[2] * z;
    let half = |row: V3<S>| {
        [
            along(row, t[0], t[3], t[4]),
            along(row, t[3], t[1], t[5]),
            along(row, t[4], t[5], t[2]),
        ]
    };
    let half = [half(r[0]), half(r[1]), half(r[2])];
    let entry = |i: usize, j: usize| dot(half[i], r[j]);
    [
        entry(0, 0),
        entry(1, 1),
        entry(2, 2),
        entry(0, 1),
        entry(0, 2),
        entry(1, 2),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(a: V3, b: V3) -> bool {
        norm(sub(a, b)) < 1e-14
    }

    #[test]
    fn rotation_is_right_handed_and_its_vector_comes_back() {
        let u = unit([0.3, -0.5, 0.8]).unwrap();
        for angle in [1e-12, 0.7, 3.0, std::f64::consts::PI] {
            let r: M3 = rotation(u, angle);
            assert!((determinant(&r) - 1.0).abs() < 1e-14);
            let back = rotation_vector(&r);
            assert!(norm(sub(back, scale(angle, u))) < 1e-9, "{angle} {back:?}");
        }
        assert!(near(
            rotate(
                &rotation([0.0, 0.0, 1.0], 0.5 * std::f64::consts::PI),
                [1.0, 0.0, 0.0]
            ),
            [0.0, 1.0, 0.0]
        ));
    }

    #[test]
    fn normals_are_orthogonal() {
        let u = unit([1.0, 2.0, -0.5]).unwrap();
        let (a, b) = normals(u);
        assert!(near(cross(a, b), u) && dot(a, u).abs() < 1e-15);
    }

    #[test]
    fn normals_do_not_jump_beside_an_axis() {
        for k in 0..3 {
            for i in 0..9 {
                let mut u = [0.0; 3];
                u[k] = 1.0;
                let straight = normals(u).0;
                u[i % 3] += [1e-17, 1e-7, -1e-7][i / 3];
                let off = norm(sub(normals(unit(u).unwrap()).0, straight));
                assert!(off < 2e-7, "{u:?}: {off}");
            }
        }
    }
}
