//! How much of a line or of a triangle lies in material, from the depths at its corners.

/// Mean of the positive part of a straight line from a to b.
pub fn positive_mean(a: f64, b: f64) -> f64 {
    match (a > 0.0, b > 0.0) {
        (true, true) => 0.5 * (a + b),
        (false, false) => 0.0,
        _ => {
            let high = a.max(b);
            0.5 * high * high / (a - b).abs()
        }
    }
}

/// Share of a line between two depths that is in.
pub(super) fn column(a: f64, b: f64) -> f64 {
    match (a > 0.0, b > 0.0) {
        (true, true) => 1.0,
        (false, false) => 0.0,
        _ => a.max(b) / (a - b).abs(),
    }
}

/// Share of a triangle that is in, the depth linear over it.
pub(super) fn inside(a: f64, b: f64, c: f64) -> f64 {
    let positive = [a, b, c].iter().filter(|x| **x > 0.0).count();
    match positive {
        3 => 1.0,
        0 => 0.0,
        _ => {
            // the corner that stands alone, and the two others
            let alone = |x: f64| (x > 0.0) == (positive == 1);
            let (one, two, three) = match (alone(a), alone(b)) {
                (true, _) => (a, b, c),
                (_, true) => (b, c, a),
                _ => (c, a, b),
            };
            let cut = one / (one - two) * (one / (one - three));
            if positive == 1 { cut } else { 1.0 - cut }
        }
    }
}
