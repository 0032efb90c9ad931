//! Whether a response follows its drive on every ramp.

use super::agreement::slope;

/// Of two ramps, and of more: the correlation on each and the ratio of their slopes from which on a response that follows all of them is
/// no chance. Two ramps of a random walk meet the first in less than one case of two hundred, of one that is integrated once more in less than
/// three (tested below); three meet the second in less than one of a hundred (tested in `relation`).
const TWO: (f64, f64) = (0.97, 1.15);
const MORE: (f64, f64) = (0.9, 2.0);

/// Whether the response follows the drive on every ramp, by slopes of one sign and much the same size.
pub(super) fn follows(ramps: &[(usize, usize)], drive: &[f64], response: &[f64]) -> bool {
    let (straight, alike) = match ramps.len() {
        0 | 1 => return false,
        2 => TWO,
        _ => MORE,
    };
    let is_straight = |ramp: &(usize, usize)| {
        let (there, xx) = slope(*ramp, drive, response);
        let (back, yy) = slope(*ramp, response, drive);
        xx > 0.0 && yy > 0.0 && there * back > straight * straight
    };
    let slopes = ramps.iter().map(|ramp| slope(*ramp, drive, response).0);
    let slopes: Vec<f64> = slopes.collect();
    let (low, high) = super::range(&slopes);
    low * high > 0.0
        && high.abs().max(low.abs()) < alike * high.abs().min(low.abs())
        && ramps.iter().all(is_straight)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::suitability::relation::ramps;
    use crate::ground::random::Random;
    use std::f64::consts::TAU;

    /// One load, one way and back.
    fn once(rows: usize) -> Vec<f64> {
        let at = |i: usize| TAU * i as f64 / (rows - 1) as f64;
        (0..rows).map(|i| 1.0 - at(i).cos()).collect()
    }

    #[test]
    fn a_gap_under_one_load_is_a_response_and_walks_are_none() {
        let load = once(240);
        let ramps = ramps(&load);
        assert_eq!(ramps.len(), 2);
        let gap: Vec<f64> = load
            .iter()
            .map(|u| u + 0.2 * ((u - 0.4) / 0.02).tanh())
            .collect();
        assert!(follows(&ramps, &load, &gap));
        let told = |smooth: bool| {
            let each = (0..1000).filter(|seed| {
                let mut random = Random::new(*seed);
                let (mut at, mut speed) = (0.0, 0.0);
                let mut step = || {
                    speed = if smooth {
                        speed + random.normal()
                    } else {
                        random.normal()
                    };
                    at += speed;
                    at
                };
                let walk: Vec<f64> = load.iter().map(|_| step()).collect();
                follows(&ramps, &load, &walk)
            });
            each.count()
        };
        let (walks, smooth) = (told(false), told(true));
        assert!(walks <= 5 && smooth <= 15, "{walks} and {smooth} of 1000");
    }
}
