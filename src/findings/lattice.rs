//! Quantisation: the lattice of distinct values.

/// Step of the lattice on which the values lie, if they do: the smallest distance between
/// neighbouring distinct values that explains nearly all the others as its multiples.
pub fn step(values: &[f64]) -> Option<f64> {
    let mut sorted: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
    sorted.sort_by(f64::total_cmp);
    let range = sorted.last()? - sorted.first()?;
    if range <= 0.0 {
        return None;
    }
    let gaps: Vec<f64> = sorted
        .windows(2)
        .map(|w| w[1] - w[0])
        .filter(|g| *g > 1e-9 * range)
        .collect();
    let mut ascending = gaps.clone();
    ascending.sort_by(f64::total_cmp);
    // rounding of the printed digits spreads a step a little: take the low quartile of the gaps
    let first = *ascending.get(ascending.len() / 4)?;
    let near: Vec<f64> = gaps
        .iter()
        .copied()
        .filter(|g| (g / first - 1.0).abs() < 0.2)
        .collect();
    let step = near.iter().sum::<f64>() / near.len().max(1) as f64;
    let multiple = |g: &&f64| {
        let k = (**g / step).round();
        k >= 1.0 && (**g - k * step).abs() < 0.2 * step
    };
    let share = gaps.iter().filter(multiple).count() as f64 / gaps.len().max(1) as f64;
    let repeats = 1.0 - gaps.len() as f64 / values.len() as f64;
    (share > 0.97 && repeats > 0.2).then_some(step)
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
