//! Quantisation: the lattice of distinct values.

use crate::findings::gain::Gain;
use crate::fit::parameter::Z95;

/// Step of the lattice on which the values lie, if they do: the largest distance between
/// neighbouring distinct values that explains nearly all the others as its multiples.
pub fn step(values: &[f64]) -> Option<f64> {
    let mut sorted: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
    sorted.sort_by(f64::total_cmp);
    let range = sorted.last()? - sorted.first()?;
    let mut gaps: Vec<f64> = sorted
        .windows(2)
        .map(|w| w[1] - w[0])
        .filter(|g| *g > 1e-7 * range)
        .collect();
    gaps.sort_by(f64::total_cmp);
    let at = |share: f64| gaps.get((share * gaps.len() as f64) as usize).copied();
    // rounding of the printed digits spreads a step a little, so several quantiles are tried
    [0.3, 0.1, 0.03, 0.0]
        .into_iter()
        .filter_map(at)
        .find_map(|first| lattice_of(&gaps, first))
}

/// The step near `first`, if nearly all gaps are its multiples.
fn lattice_of(gaps: &[f64], first: f64) -> Option<f64> {
    let near: Vec<f64> = gaps
        .iter()
        .copied()
        .filter(|g| (g / first - 1.0).abs() < 0.15)
        .collect();
    let step = near.iter().sum::<f64>() / near.len().max(1) as f64;
    // only short distances can tell a multiple from chance
    let short: Vec<f64> = gaps
        .iter()
        .map(|g| g / step)
        .filter(|k| *k < LONGEST)
        .collect();
    let multiples = short
        .iter()
        .filter(|k| k.round() >= 1.0 && (*k - k.round()).abs() < 0.1)
        .count();
    let enough = short.len() >= 10 && 2 * short.len() > gaps.len();
    (enough && multiples as f64 > 0.95 * short.len() as f64).then_some(step)
}

/// Steps beyond which a distance says nothing about the lattice.
const LONGEST: f64 = 8.5;

/// Probability that a lattice which was found is one: by chance each of at least ten distances would
/// lie within a tenth of a multiple with probability 0.2, at four steps tried.
pub const CERTAINTY: f64 = 1.0 - 4.0 * 1.024e-7;

/// What a finer converter would gain: error `rms` with its rounding, variance step²/12 (Widrow and
/// Kollár 2008), and without. The interval follows from the relative standard error of rms².
pub fn gain(step: f64, rms: f64, relative_error: f64) -> Gain {
    let left = |variance: f64| (1.0 - step * step / 12.0 / variance).max(0.0).sqrt();
    let square = rms * rms;
    let percent = |variance: f64| 100.0 * (1.0 - left(variance));
    let half = (Z95 * relative_error).min(0.9);
    Gain {
        before: rms,
        after: rms * left(square),
        reduction_percent: percent(square),
        ci95_percent: [
            percent(square * (1.0 + half)),
            percent(square * (1.0 - half)),
        ],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ground::random::Random;

    #[test]
    fn finds_a_coarse_lattice_and_no_other() {
        let mut random = Random::new(5);
        let smooth: Vec<f64> = (0..900)
            .map(|i| (f64::from(i) * 0.02).sin() + 0.01 * random.normal())
            .collect();
        let coarse: Vec<f64> = smooth
            .iter()
            .map(|v| (v / 0.04).round() * 0.04 + 1e-7 * random.normal())
            .collect();
        assert!((step(&coarse).unwrap() / 0.04 - 1.0).abs() < 1e-3);
        assert_eq!(step(&smooth), None);
    }
}
