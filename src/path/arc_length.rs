//! True arc length of a curve given by a parameter: Gauss–Legendre quadrature on panels that are
//! halved until they agree, and Newton's method back from length to parameter.

use crate::ground::vector::{V3, norm};

/// Nodes and weights of eight points on −1 to 1, positive half.
const GAUSS: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_48),
    (0.960_289_856_497_536_2, 0.101_228_536_290_376_26),
];
/// A panel is fine if its halves agree with it to this share: their own error is then smaller by
/// about 2¹⁶.
const AGREE: f64 = 1e-9;
/// Panels are halved at most this often.
const DEPTH: usize = 24;

/// A curve over a parameter.
pub trait Parametric {
    /// Place (m) and its first two derivatives by the parameter.
    fn derivatives(&self, u: f64) -> [V3; 3];

    /// First derivative alone, m.
    fn velocity(&self, u: f64) -> V3 {
        self.derivatives(u)[1]
    }
}

/// Arc length over the parameter at the ends of panels.
#[derive(Debug, Clone, PartialEq)]
pub struct ArcLength {
    /// Parameter and length (m) from the start, increasing.
    nodes: Vec<[f64; 2]>,
}

impl ArcLength {
    /// Of a curve that is smooth between neighbouring `breaks` (at least two, increasing).
    pub fn of(curve: &impl Parametric, breaks: &[f64]) -> Self {
        let mut table = Self {
            nodes: vec![[breaks[0], 0.0]],
        };
        for ends in breaks.windows(2) {
            let whole = length(curve, ends[0], ends[1]);
            table.refine(curve, [ends[0], ends[1]], whole, DEPTH);
        }
        table
    }

    fn refine(&mut self, curve: &impl Parametric, [a, b]: [f64; 2], whole: f64, depth: usize) {
        let middle = 0.5 * (a + b);
        let halves = [length(curve, a, middle), length(curve, middle, b)];
        let sum = halves[0] + halves[1];
        if depth == 0 || (sum - whole).abs() <= AGREE * sum {
            self.push(middle, halves[0]);
            self.push(b, halves[1]);
        } else {
            self.refine(curve, [a, middle], halves[0], depth - 1);
            self.refine(curve, [middle, b], halves[1], depth - 1);
        }
    }

    fn push(&mut self, u: f64, more: f64) {
        self.nodes.push([u, self.total() + more]);
    }

    /// Length of the whole curve, m.
    pub fn total(&self) -> f64 {
        self.nodes.last().map_or(0.0, |node| node[1])
    }

    /// Length from the start to `u`, m.
    pub fn to(&self, curve: &impl Parametric, u: f64) -> f64 {
        let i = self.panel(0, u);
        self.nodes[i][1] + length(curve, self.nodes[i][0], u)
    }

    /// The parameter at length `s` (m) from the start; beyond the ends: that of the end.
    pub fn parameter(&self, curve: &impl Parametric, s: f64) -> f64 {
        let s = s.clamp(0.0, self.total());
        let i = self.panel(1, s);
        let ([a, from], [b, to]) = (self.nodes[i], self.nodes[i + 1]);
        let mut u = if to > from {
            a + (b - a) * (s - from) / (to - from)
        } else {
            a
        };
        for _ in 0..20 {
            let miss = from + length(curve, a, u) - s;
            let speed = norm(curve.velocity(u));
            let step = if speed > 0.0 { miss / speed } else { 0.0 };
            u = (u - step).clamp(a, b);
            if miss.abs() <= 1e-12 * (to - from) || step.abs() <= 1e-15 * (b - a) {
                break;
            }
        }
        u
    }

    /// Index of the panel that holds `value` of the given column.
    fn panel(&self, column: usize, value: f64) -> usize {
        let after = self.nodes.partition_point(|node| node[column] <= value);
        after.clamp(1, self.nodes.len() - 1) - 1
    }
}

/// Length between two parameters, one panel, m.
fn length(curve: &impl Parametric, a: f64, b: f64) -> f64 {
    let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
    let pair = |(x, w): &(f64, f64)| {
        let (left, right) = (middle - half * x, middle + half * x);
        w * (norm(curve.velocity(left)) + norm(curve.velocity(right)))
    };
    half * GAUSS.iter().map(pair).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// y = x², whose length is known: x/2·√(1+4x²) + asinh(2x)/4.
    struct Parabola;

    impl Parametric for Parabola {
        fn derivatives(&self, u: f64) -> [V3; 3] {
            [[u, u * u, 0.0], [1.0, 2.0 * u, 0.0], [0.0, 2.0, 0.0]]
        }
    }

    #[test]
    fn a_parabola_is_as_long_as_its_closed_form() {
        let exact = |x: f64| 0.5 * x * (1.0 + 4.0 * x * x).sqrt() + 0.25 * (2.0 * x).asinh();
        let table = ArcLength::of(&Parabola, &[0.0, 1.0, 30.0]);
        assert!((table.total() / exact(30.0) - 1.0).abs() < 1e-13);
        for x in [0.0, 1e-6, 0.3, 1.0, 17.0, 29.999, 30.0] {
            assert!((table.to(&Parabola, x) - exact(x)).abs() < 1e-12 * exact(30.0));
            assert!((table.parameter(&Parabola, exact(x)) - x).abs() < 1e-12 * 30.0);
        }
    }
}
