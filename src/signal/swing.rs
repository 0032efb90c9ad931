//! Swings that die away: a mode that was hit.

use std::f64::consts::TAU;

/// Shares of critical damping that are tried.
const DAMPINGS: [f64; 3] = [0.03, 0.07, 0.15];
/// Rows of the shortest period, and periods that must be seen.
const PERIODS: (f64, f64) = (2.5, 2.0);

/// Share of the squares of values that the best swing from their first on takes, and how many were tried.
pub fn swing(values: &[f64]) -> (f64, usize) {
    let all: f64 = values.iter().map(|v| v * v).sum();
    let shapes = shapes(PERIODS.0, values.len() as f64 / PERIODS.1, &DAMPINGS);
    let each = shapes.iter().map(|(period, damping)| {
        let omega = TAU / period;
        let keep = |i: f64| (-damping * omega * i).exp();
        let phase = |f: fn(f64) -> f64| -> Vec<f64> {
            let rows = 0..values.len();
            rows.map(|i| keep(i as f64) * f(omega * i as f64)).collect()
        };
        taken([&phase(f64::cos), &phase(f64::sin)], values)
    });
    let best = each.fold(0.0, f64::max);
    (best / all.max(f64::MIN_POSITIVE), shapes.len())
}

/// Periods from one to another, with each of some dampings, each as far from the next as it is wide.
pub fn shapes(least: f64, most: f64, dampings: &[f64]) -> Vec<(f64, f64)> {
    let each = dampings.iter().flat_map(|damping| {
        let count = ((most / least).ln() / damping).max(0.0) as usize;
        (0..count).map(move |k| (least * (damping * k as f64).exp(), *damping))
    });
    each.collect()
}

/// Squares that two columns take of values.
pub fn taken([a, b]: [&[f64]; 2], values: &[f64]) -> f64 {
    let dot = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(p, q)| p * q).sum::<f64>();
    let (aa, ab, bb) = (dot(a, a), dot(a, b), dot(b, b));
    let (ay, by) = (dot(a, values), dot(b, values));
    let det = aa * bb - ab * ab;
    match det > 1e-9 * aa * bb {
        true => (bb * ay * ay - 2.0 * ab * ay * by + aa * by * by) / det,
        false => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_swing_is_found_and_a_slope_is_none() {
        let at = |i: usize| (-(i as f64) / 14.0).exp() * (0.7 * i as f64 + 0.4).sin();
        let values: Vec<f64> = (0..60).map(at).collect();
        assert!(swing(&values).0 > 0.95);
        let slope: Vec<f64> = (0..60).map(|i| 1.0 - i as f64 / 60.0).collect();
        assert!(swing(&slope).0 < 0.8);
        assert_eq!(taken([&[1.0, 0.0], &[0.0, 2.0]], &[3.0, 4.0]), 25.0);
    }
}
