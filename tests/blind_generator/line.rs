//! What the best straight line leaves over.

/// What stays in a straight line's way: which of its two terms may absorb an effect.
#[derive(Clone, Copy, PartialEq)]
pub enum Line {
    /// a + b u.
    Full,
    /// b u only: a constant counts as part of the effect.
    SlopeOnly,
}

/// Residual of the least-squares line of `y` over `u`.
pub fn residual(y: &[f64], u: &[f64], line: Line) -> Vec<f64> {
    let n = y.len() as f64;
    let (mean_y, mean_u) = match line {
        Line::Full => (y.iter().sum::<f64>() / n, u.iter().sum::<f64>() / n),
        Line::SlopeOnly => (0.0, 0.0),
    };
    let pairs = || y.iter().zip(u).map(|(y, u)| (y - mean_y, u - mean_u));
    let slope = pairs().map(|(y, u)| y * u).sum::<f64>() / pairs().map(|(_, u)| u * u).sum::<f64>();
    pairs().map(|(y, u)| y - slope * u).collect()
}

/// Largest absolute residual of the least-squares line.
pub fn peak(y: &[f64], u: &[f64], line: Line) -> f64 {
    let rest = residual(y, u, line);
    rest.iter().fold(0.0, |m: f64, x| m.max(x.abs()))
}

/// Finds x in [low, high] with f(x) = target for rising f, by bisection.
pub fn bisect(mut low: f64, mut high: f64, target: f64, f: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if f(middle) < target {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}
