//! The lattice of the distinct values of a record: the resolution of what read it.

use crate::ground::stats::mean;

/// Step of the lattice on which the values lie, if they do: the largest distance between
/// neighbouring distinct values that explains nearly all the others as its multiples.
pub fn step(values: &[f64]) -> Option<f64> {
    step_of(&mut gaps(values))
}

/// Distances between neighbouring distinct values.
pub fn gaps(values: &[f64]) -> Vec<f64> {
    let mut sorted: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
    sorted.sort_by(f64::total_cmp);
    let range = sorted
        .last()
        .zip(sorted.first())
        .map_or(0.0, |(l, f)| l - f);
    let gaps = sorted.windows(2).map(|w| w[1] - w[0]);
    gaps.filter(|g| *g > 1e-7 * range).collect()
}

/// The same as [`step`] of distances, which may come from several records.
pub fn step_of(gaps: &mut [f64]) -> Option<f64> {
    gaps.sort_by(f64::total_cmp);
    let at = |share: f64| gaps.get((share * gaps.len() as f64) as usize).copied();
    // rounding of the printed digits spreads a step a little, so several quantiles are tried
    [0.3, 0.1, 0.03, 0.0]
        .into_iter()
        .filter_map(at)
        .find_map(|first| lattice_of(gaps, first))
}

/// Distinct values from which on distances that are all multiples of the least are no chance.
const LEVELS: usize = 6;
/// The same within this share of the least.
const EXACT: f64 = 0.03;
/// Share of neighbouring readings that are equal where noise is below a step.
const EQUAL: f64 = 0.6;

/// Step of a lattice so coarse that readings mostly repeat the one before: the noise does not show, whatever a
/// fit takes for it.
pub fn plain_step(values: &[f64]) -> Option<f64> {
    let pairs = values.windows(2);
    let equal = pairs.clone().filter(|w| w[0] == w[1]).count();
    if (equal as f64) < EQUAL * pairs.len() as f64 {
        return None;
    }
    least_of(&gaps(values))
}

/// The least of these distances if they are many and all its multiples.
pub fn least_of(gaps: &[f64]) -> Option<f64> {
    let step = gaps.iter().copied().reduce(f64::min)?;
    let near = |gap: &f64| (gap / step - (gap / step).round()).abs() < EXACT;
    (gaps.len() + 1 >= LEVELS && gaps.iter().all(near)).then_some(step)
}

/// The step near `first`, if nearly all gaps are its multiples.
fn lattice_of(gaps: &[f64], first: f64) -> Option<f64> {
    let near: Vec<f64> = gaps
        .iter()
        .copied()
        .filter(|g| (g / first - 1.0).abs() < 0.15)
        .collect();
    let step = mean(&near);
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

    #[test]
    fn finds_the_lattice_of_a_few_levels() {
        let mut random = Random::new(5);
        let level = |i: usize| 0.31 * [0.0, 1.0, 2.0, 3.0, 2.0, 1.0][(i / 20) % 6];
        let fine: Vec<f64> = (0..240)
            .map(|i| level(i) + 0.01 * random.normal())
            .collect();
        let read = |step: f64| {
            fine.iter()
                .map(|v| (v / step).round() * step)
                .collect::<Vec<f64>>()
        };
        assert_eq!(plain_step(&fine), None);
        assert_eq!(plain_step(&read(0.01)), None);
        let coarse: Vec<f64> = (0..240).map(|i| i as f64 / 30.0).map(f64::floor).collect();
        assert_eq!(plain_step(&coarse), Some(1.0));
    }
}
