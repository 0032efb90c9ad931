//! Small algebra of the judges.

/// Inner product.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// What is left of `v` once everything in the span of `columns` is taken out (modified Gram and Schmidt, twice).
pub fn beyond(v: &[f64], columns: &[Vec<f64>]) -> Vec<f64> {
    without(v, &basis(columns))
}

/// Orthonormal columns of the same span.
pub fn basis(columns: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let mut basis: Vec<Vec<f64>> = Vec::new();
    for column in columns {
        let whole = dot(column, column);
        let left = without(column, &basis);
        let size = dot(&left, &left);
        if size > 1e-18 * whole.max(1e-300) {
            basis.push(left.iter().map(|x| x / size.sqrt()).collect());
        }
    }
    basis
}

/// What is left of `v` beyond orthonormal columns.
pub fn without(v: &[f64], basis: &[Vec<f64>]) -> Vec<f64> {
    let mut left = v.to_vec();
    for _ in 0..2 {
        for b in basis {
            let share = dot(&left, b);
            left.iter_mut().zip(b).for_each(|(l, x)| *l -= share * x);
        }
    }
    left
}

/// Length of what is left of `v` beyond `columns`.
pub fn length_beyond(v: &[f64], columns: &[Vec<f64>]) -> f64 {
    let left = beyond(v, columns);
    dot(&left, &left).sqrt()
}

/// Three numbers.
pub type V3 = [f64; 3];

/// Unit quaternion, scalar first.
pub type Quat = [f64; 4];

/// Product of quaternions.
pub fn times(a: Quat, b: Quat) -> Quat {
    [
        a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
        a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
        a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
        a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
    ]
}

/// The turn about a unit axis by an angle, rad.
pub fn turn(axis: V3, angle: f64) -> Quat {
    let (s, c) = (0.5 * angle).sin_cos();
    [c, s * axis[0], s * axis[1], s * axis[2]]
}

/// The other way.
pub fn inverse(q: Quat) -> Quat {
    [q[0], -q[1], -q[2], -q[3]]
}

/// A vector turned: v + 2w (u × v) + 2u × (u × v).
pub fn turned(q: Quat, v: V3) -> V3 {
    let u = [q[1], q[2], q[3]];
    let once = cross(u, v);
    let twice = cross(u, once);
    std::array::from_fn(|i| v[i] + 2.0 * q[0] * once[i] + 2.0 * twice[i])
}

/// Cross product.
pub fn cross(a: V3, b: V3) -> V3 {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// Sum.
pub fn plus(a: V3, b: V3) -> V3 {
    std::array::from_fn(|i| a[i] + b[i])
}

/// Difference.
pub fn minus(a: V3, b: V3) -> V3 {
    std::array::from_fn(|i| a[i] - b[i])
}

/// Multiple.
pub fn scaled(a: V3, s: f64) -> V3 {
    a.map(|x| x * s)
}

/// Length.
pub fn norm(a: V3) -> f64 {
    dot(&a, &a).sqrt()
}

/// Unit vector along.
pub fn unit(a: V3) -> V3 {
    scaled(a, 1.0 / norm(a))
}

/// The unit vector along an axis.
pub fn axis(i: usize) -> V3 {
    std::array::from_fn(|k| f64::from(u8::from(k == i)))
}
