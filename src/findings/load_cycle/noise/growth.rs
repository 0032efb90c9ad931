//! Noise that grows with the load, and bursts.

use super::{differences, is_swinging};
use crate::findings::load_cycle::families::View;
use crate::ground::stats::{mean, median, rms};
use std::ops::Range;

/// Growths of the deviation from no load to full load that are tried.
const GROWTHS: [f64; 5] = [0.5, 1.0, 2.0, 4.0, 8.0];
/// Nats by which a growth, and a burst, must be better than none.
const BETTER: (f64, f64) = (4.0, 8.0);
/// Windows in which bursts are sought, and the factors that are bursts: more is a loose plug.
const WINDOWS: usize = 40;
const BURST: (f64, f64) = (1.6, 6.0);
/// Standard errors from zero beyond which the mean of bursts is none of noise: neighbours are alike.
const ONE_SIDED: f64 = 5.0;

/// Growth of the deviation from no load to full load, if that is better than none.
pub(super) fn growth(residual: &[f64], view: &View) -> Option<f64> {
    let jumps = differences(residual);
    let likelihood = |growth: f64| {
        let factors: Vec<f64> = view
            .u
            .windows(2)
            .map(|w| 1.0 + growth * 0.5 * (w[0] + w[1]).abs())
            .collect();
        let flat: Vec<f64> = jumps.iter().zip(&factors).map(|(j, f)| j / f).collect();
        let logs: f64 = factors.iter().map(|f| f.ln()).sum();
        -logs - flat.len() as f64 * rms(&flat).max(f64::MIN_POSITIVE).ln()
    };
    let none = likelihood(0.0);
    let best = GROWTHS
        .into_iter()
        .map(|g| (likelihood(g), g))
        .max_by(|a, b| a.0.total_cmp(&b.0))?;
    (best.0 > none + BETTER.0).then_some(best.1)
}

/// Factor of every reading's deviation in bursts; a loose plug pulls one way and what was hit swings, noise does neither.
pub(super) fn bursts(residual: &[f64]) -> Vec<f64> {
    let mut factors = vec![1.0; residual.len()];
    let windows = windows(residual);
    if is_one_sided(residual, &windows) || is_swinging(residual, &windows) {
        return factors;
    }
    for (own, f) in windows.into_iter().filter(|w| w.1 < BURST.1) {
        factors[own]
            .iter_mut()
            .for_each(|v: &mut f64| *v = v.max(f));
    }
    factors
}

/// Pieces of a residual that are noisier than the others, and how much.
pub fn windows(residual: &[f64]) -> Vec<(Range<usize>, f64)> {
    let n = residual.len();
    let jumps = differences(residual);
    let wide = (n / WINDOWS).max(8);
    if n < 4 * wide {
        return Vec::new();
    }
    let windows: Vec<(usize, f64)> = (0..jumps.len() - wide)
        .step_by(wide / 2)
        .map(|i| (i, rms(&jumps[i..i + wide])))
        .collect();
    let typical = median(&windows.iter().map(|w| w.1).collect::<Vec<_>>()).max(f64::MIN_POSITIVE);
    let louder = |(start, size): (usize, f64)| {
        let f = size / typical;
        let nats = wide as f64 * (0.5 * (f * f - 1.0) - f.ln());
        let end = (start + wide + 1).min(n);
        (f > BURST.0 && nats > BETTER.1).then_some((start..end, f))
    };
    windows.into_iter().filter_map(louder).collect()
}

/// Whether the readings of such pieces lie to one side of the others: no noise does that.
pub fn is_one_sided(residual: &[f64], windows: &[(Range<usize>, f64)]) -> bool {
    let mut inside = vec![false; residual.len()];
    for (own, _) in windows {
        inside[own.clone()].fill(true);
    }
    let part = |wanted: bool| -> Vec<f64> {
        let rows = residual.iter().zip(&inside).filter(|(_, i)| **i == wanted);
        rows.map(|r| *r.0).collect()
    };
    let (own, others) = (part(true), part(false));
    if own.is_empty() || others.is_empty() {
        return false;
    }
    let middle = median(&others);
    let off: Vec<f64> = own.iter().map(|v| v - middle).collect();
    mean(&off).abs() > ONE_SIDED * rms(&off) / (off.len() as f64).sqrt()
}
