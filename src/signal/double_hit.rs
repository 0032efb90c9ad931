//! A second pulse in the force record of one hit.

use super::pulse::Pulse;

/// Lowest second pulse that is called one, as a share of the main pulse.
const SHARE: f64 = 0.035;

/// Samples beside the main pulse that are left to the ringing of filters.
const GUARD: usize = 3;

/// A second pulse.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Second {
    /// Samples from the main peak to the second; negative: before it.
    pub after: isize,
    /// Its height as a share of the main peak.
    pub share: f64,
}

/// The highest other pulse in `force`, if any stands clear of noise, filter ringing, hum and a
/// slowly returning baseline. The shape of the main pulse plays no part, so soft tips are not
/// suspicious.
pub fn second_pulse(force: &[f64], pulse: &Pulse) -> Option<Second> {
    let half = pulse.width() / 8;
    let smooth = smoothed(force, pulse, half);
    let later = (pulse.end + GUARD..force.len()).collect::<Vec<_>>();
    let earlier = (0..pulse.start.saturating_sub(GUARD))
        .rev()
        .collect::<Vec<_>>();
    let noise = pulse.noise / ((2 * half + 1) as f64).sqrt();
    let level = (SHARE * pulse.peak.abs()).max(6.0 * noise);
    let found = [later, earlier];
    let found = found.iter().flat_map(|places| peaks(&smooth, places));
    found
        .filter(|found| {
            found.prominence.min(smooth[found.at]) > level && is_pulse(&smooth, found, pulse)
        })
        .max_by(|a, b| a.prominence.total_cmp(&b.prominence))
        .map(|found| Second {
            after: found.at as isize - pulse.at as isize,
            share: smooth[found.at] / pulse.peak.abs(),
        })
}

/// Force above the baseline in the direction of the hit, averaged over `2·half + 1` samples.
fn smoothed(force: &[f64], pulse: &Pulse, half: usize) -> Vec<f64> {
    let above = (0..force.len()).map(|i| pulse.above(force, i));
    let mut sums = vec![0.0];
    for value in above {
        sums.push(sums[sums.len() - 1] + value);
    }
    let mean = |i: usize| {
        let (low, high) = (i.saturating_sub(half), (i + half + 1).min(force.len()));
        (sums[high] - sums[low]) / (high - low) as f64
    };
    (0..force.len()).map(mean).collect()
}

struct Peak {
    at: usize,
    prominence: f64,
}

/// The local maxima on the way from the main pulse, with their rise above the lowest place passed.
fn peaks(smooth: &[f64], places: &[usize]) -> Vec<Peak> {
    let mut valley = f64::INFINITY;
    let rises = places.windows(3).filter_map(|three| {
        let [before, here, after] = [three[0], three[1], three[2]].map(|i| smooth[i]);
        valley = valley.min(before);
        let top = here >= before && here > after;
        top.then_some(Peak {
            at: three[1],
            prominence: here - valley,
        })
    });
    rises.collect()
}

/// One-sided (not ringing or hum) and about as short as the main pulse (not a drift).
fn is_pulse(smooth: &[f64], found: &Peak, pulse: &Pulse) -> bool {
    let near = 4 * pulse.width() + 8;
    let near = near.min(found.at.abs_diff(pulse.at) / 2);
    let around = found.at.saturating_sub(near)..(found.at + near).min(smooth.len());
    let lowest = around.map(|i| -smooth[i]).fold(0.0, f64::max);
    let height = smooth[found.at];
    let half = (height - 0.5 * found.prominence).max(0.5 * height);
    let upper = |i: &usize| smooth[*i] > half;
    let right = (found.at..smooth.len()).take_while(upper).count();
    let left = (0..found.at).rev().take_while(upper).count();
    smooth[found.at] > 1.5 * lowest && left + right <= 4 * pulse.width() + 6
}
