//! Means, sizes, quantiles and sums of exponentials: written once.

use statrs::function::erf::erfc;

/// 97.5 % point of the normal distribution: half width of a 95 % interval in standard deviations.
pub const Z95: f64 = 1.959_963_984_540_054;

/// Arithmetic mean; 0 of nothing.
pub fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}

/// Root of the mean square, not less the mean; 0 of nothing.
pub fn rms(values: &[f64]) -> f64 {
    (values.iter().map(|v| v * v).sum::<f64>() / values.len().max(1) as f64).sqrt()
}

/// Probability that a normal number lies above so many deviations.
pub fn above(deviations: f64) -> f64 {
    0.5 * erfc(deviations / std::f64::consts::SQRT_2)
}

/// What `a` has more than `b`, value by value.
pub fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

/// Length as of a vector: root of the sum of squares.
pub fn length(values: &[f64]) -> f64 {
    values.iter().map(|v| v * v).sum::<f64>().sqrt()
}

/// Largest size, sign apart; 0 of nothing.
pub fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, v| most.max(v.abs()))
}

/// Index of the largest size, sign apart; none of nothing.
pub fn farthest(values: &[f64]) -> Option<usize> {
    (0..values.len()).max_by(|a, b| values[*a].abs().total_cmp(&values[*b].abs()))
}

/// Indices from the largest value to the smallest.
pub fn descending(values: &[f64]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|a, b| values[*b].total_cmp(&values[*a]));
    order
}

/// Smallest and largest; the ends of all numbers, upside down, of nothing.
pub fn ends(values: &[f64]) -> (f64, f64) {
    values.iter().fold((f64::MAX, f64::MIN), |(low, high), v| {
        (low.min(*v), high.max(*v))
    })
}

/// Median of the square of a normal number of deviation one.
pub const MEDIAN_OF_SQUARES: f64 = 0.455;

/// Value below which the share `q` (0 to 1) of the values lies, linear between order statistics; 0 of nothing.
pub fn quantile(values: &[f64], q: f64) -> f64 {
    let mut values = values.to_vec();
    let Some(last) = values.len().checked_sub(1) else {
        return 0.0;
    };
    let at = q.clamp(0.0, 1.0) * last as f64;
    let (_, low, above) = values.select_nth_unstable_by(at.floor() as usize, f64::total_cmp);
    let next = above.iter().copied().min_by(f64::total_cmp);
    let high = next.filter(|_| at.fract() > 0.0).unwrap_or(*low);
    *low + (high - *low) * at.fract()
}

/// Median; 0 of nothing.
pub fn median(values: &[f64]) -> f64 {
    quantile(values, 0.5)
}

/// ln Σ exp(v), without overflow; minus infinity of nothing.
pub fn log_sum_exp(values: impl Iterator<Item = f64> + Clone) -> f64 {
    let top = values.clone().fold(f64::NEG_INFINITY, f64::max);
    match top.is_finite() {
        true => top + values.map(|v| (v - top).exp()).sum::<f64>().ln(),
        false => top,
    }
}

/// 97.5 % point of Student's t, for intervals whose variance rests on few degrees of freedom (at least 1).
pub fn t95(freedom: f64) -> f64 {
    use statrs::distribution::{ContinuousCDF, StudentsT};
    StudentsT::new(0.0, 1.0, freedom.max(1.0)).map_or(Z95, |t| t.inverse_cdf(0.975))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_lie_between_order_statistics() {
        assert_eq!(median(&[3.0, 1.0, 2.0]), 2.0);
        assert_eq!(median(&[4.0, 1.0, 2.0, 3.0]), 2.5);
        assert_eq!(quantile(&[], 0.9), 0.0);
    }

    #[test]
    fn sums_of_exponentials_do_not_overflow() {
        let sum = log_sum_exp([1000.0, 1000.0].into_iter());
        assert!((sum - 1000.0 - 2.0_f64.ln()).abs() < 1e-12);
        assert_eq!(log_sum_exp([].into_iter()), f64::NEG_INFINITY);
    }
}
