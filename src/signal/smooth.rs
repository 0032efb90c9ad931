//! Noise of a smooth history with corners.

use super::outliers::robust_std;

/// Noise of a smooth history with corners, from fourth differences (von Neumann 1941).
pub fn noise(values: &[f64]) -> f64 {
    let fourth = |w: &[f64]| w[0] - 4.0 * w[1] + 6.0 * w[2] - 4.0 * w[3] + w[4];
    let differences: Vec<f64> = values
        .windows(5)
        .map(fourth)
        .filter(|v| v.is_finite())
        .collect();
    robust_std(&differences) / 70.0_f64.sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ground::random::Random;

    #[test]
    fn sees_noise_and_not_the_curve() {
        let mut random = Random::new(1);
        let noisy: Vec<f64> = (0..400)
            .map(|i| (f64::from(i) * 0.05).sin() + 0.01 * random.normal())
            .collect();
        assert!((noise(&noisy) / 0.01 - 1.0).abs() < 0.2);
    }
}
