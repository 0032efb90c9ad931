//! Single wild readings: found against their neighbours, replaced and counted.

use crate::ground::stats::ends;

/// Robust standard deviation: 1.4826 · median |x − median|.
pub fn robust_std(values: &[f64]) -> f64 {
    if values.is_empty() {
        return 0.0;
    }
    let middle = median(values);
    let distances: Vec<f64> = values.iter().map(|v| (v - middle).abs()).collect();
    1.4826 * median(&distances)
}

/// Third differences of neighbours, each of the deviation of one reading: no smooth course shows in them, and neither steps nor bends in their
/// median.
pub fn third_differences(values: &[f64]) -> Vec<f64> {
    let third = |w: &[f64]| (w[3] - 3.0 * w[2] + 3.0 * w[1] - w[0]) / 20.0_f64.sqrt();
    values.windows(4).map(third).collect()
}

/// Median; 0 for no values.
pub fn median(values: &[f64]) -> f64 {
    if values.is_empty() {
        return 0.0;
    }
    let mut sorted = values.to_vec();
    let middle = sorted.len() / 2;
    *sorted.select_nth_unstable_by(middle, f64::total_cmp).1
}

/// Jumps that tell their spread; of longer records every second, third ... is taken.
const ENOUGH: usize = 1 << 16;

/// Rows that stand alone: outside the range of their four neighbours by more than `limit` robust
/// standard deviations of the jumps between neighbours. A step or a knee stays inside that range.
pub fn isolated(values: &[f64], limit: f64) -> Vec<usize> {
    let n = values.len();
    if n < 8 {
        return Vec::new();
    }
    let jump = |i: usize| values[i + 1] - values[i];
    let some = (n / ENOUGH).max(1);
    let jumps: Vec<f64> = (0..n - 1).step_by(some).map(jump).collect();
    let spread = robust_std(&jumps);
    if spread <= 0.0 {
        return Vec::new();
    }
    (2..n - 2)
        .filter(|i| beyond(values, *i) > limit * spread)
        .collect()
}

/// How far a value lies outside the range of its four neighbours.
fn beyond(values: &[f64], i: usize) -> f64 {
    let near = [values[i - 2], values[i - 1], values[i + 1], values[i + 2]];
    let (low, high) = ends(&near);
    (values[i] - high).max(low - values[i]) - (high - low)
}

/// Rows of a residual that stand alone: off the median of their neighbours by more than `limit` robust
/// standard deviations of that distance, while the rows beside them are calm. For what a model has
/// flattened already: a knee that it missed would have company.
pub fn lone(residual: &[f64], limit: f64) -> Vec<usize> {
    let n = residual.len();
    if n < 8 {
        return Vec::new();
    }
    let off: Vec<f64> = (0..n)
        .map(|i| residual[i] - neighbours(residual, i))
        .collect();
    let spread = robust_std(&off);
    let calm = |i: usize| off[i].abs() <= 0.6 * limit * spread;
    (1..n - 1)
        .filter(|i| off[*i].abs() > limit * spread && calm(i - 1) && calm(i + 1))
        .collect()
}

/// Median of the four nearest neighbours.
pub fn neighbours(values: &[f64], i: usize) -> f64 {
    let n = values.len();
    let mut near: Vec<f64> = [i.wrapping_sub(2), i.wrapping_sub(1), i + 1, i + 2]
        .into_iter()
        .filter(|j| *j < n)
        .map(|j| values[j])
        .collect();
    near.sort_by(f64::total_cmp);
    0.5 * (near[(near.len() - 1) / 2] + near[near.len() / 2])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spike_is_isolated_a_step_is_not() {
        let mut values: Vec<f64> = (0..200).map(|i| f64::from(i * 7919 % 13) * 0.01).collect();
        values[50] += 3.0;
        values[120..].iter_mut().for_each(|v| *v += 3.0);
        assert_eq!(isolated(&values, 6.0), vec![50]);
    }
}
