//! Measurement noise with a colour.

use crate::ground::random::Random;

/// First-order autoregressive noise of a given rms; `correlation` of neighbours in 0..1.
pub fn autoregressive(n: usize, rms: f64, correlation: f64, random: &mut Random) -> Vec<f64> {
    let innovation = rms * (1.0 - correlation * correlation).max(0.0).sqrt();
    let mut value = rms * random.normal();
    (0..n)
        .map(|_| {
            let now = value;
            value = correlation * value + innovation * random.normal();
            now
        })
        .collect()
}
