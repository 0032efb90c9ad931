//! Whether a record holds the decay of its response.

use super::outliers::median;
use super::pulse::{Pulse, spread};
use crate::ground::stats::mean;

/// Rms of the last tenth of a response as a share of the rms of the first tenth after the hit, noise
/// and mean taken off both; `average` samples are averaged first, so that only the band of interest counts.
/// Above 0.05 the record is shorter than 3 time constants (Trethewey and Cafeo 1992 ask for 6).
pub fn residual_ring(response: &[f64], pulse: &Pulse, average: usize) -> f64 {
    let average = average.max(1);
    let blocks: Vec<f64> = response[pulse.start.min(response.len())..]
        .chunks_exact(average)
        .map(mean)
        .collect();
    let tenth = blocks.len() / 10;
    if tenth == 0 {
        return 0.0;
    }
    let quiet = &response[..pulse.start];
    let noise = if quiet.len() < 16 {
        0.0
    } else {
        spread(quiet, median(quiet)).powi(2) / average as f64
    };
    let power = |part: &[f64]| {
        let middle = mean(part);
        let sum: f64 = part.iter().map(|v| (v - middle).powi(2)).sum();
        (sum / part.len() as f64 - noise).max(0.0)
    };
    let first = power(&blocks[..tenth]);
    let last = power(&blocks[blocks.len() - tenth..]);
    if first > 0.0 {
        (last / first).sqrt()
    } else {
        0.0
    }
}
