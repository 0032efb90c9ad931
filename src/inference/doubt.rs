//! How far a model is wrong anyway. What is put up with is a guess before the data; rows that agree far better with what was
//! found show it to be too large, and what is hidden below it becomes visible.

/// Shares of the guess that are tried.
const SHARES: [f64; 13] = [
    1.0, 0.84, 0.71, 0.59, 0.5, 0.42, 0.35, 0.3, 0.25, 0.21, 0.18, 0.15, 0.125,
];
/// Nats below the likeliest share at which one is contradicted: half the square of 1.96 deviations.
const CONTRADICTED: f64 = 1.92;

/// The largest share of a guess, no less than `least`, that is not contradicted by the logarithm of its likelihood.
pub fn largest_share(least: f64, likelihood: impl Fn(f64) -> f64) -> f64 {
    let tried = SHARES.iter().filter(|share| **share >= least);
    let all: Vec<(f64, f64)> = tried.map(|share| (*share, likelihood(*share))).collect();
    let best = all.iter().map(|l| l.1).fold(f64::MIN, f64::max);
    let fits = all.iter().find(|l| l.1 >= best - CONTRADICTED);
    fits.map_or(1.0, |l| l.0)
}

#[cfg(test)]
mod tests {
    use super::largest_share;
    use crate::ground::random::Random;

    /// Numbers of a deviation that is a share of the guess of one: the guess is kept, or shrinks towards it from above.
    #[test]
    fn a_guess_shrinks_no_further_than_numbers_contradict_it() {
        let mut random = Random::new(3);
        let numbers: Vec<f64> = (0..300).map(|_| random.normal()).collect();
        let of = |truth: f64| {
            largest_share(0.25, |share| {
                let density = |x: &f64| -0.5 * (truth * x / share).powi(2) - share.ln();
                numbers.iter().map(density).sum()
            })
        };
        assert_eq!(of(1.0), 1.0);
        assert_eq!(of(2.0), 1.0);
        let half = of(0.5);
        assert!((0.5..0.6).contains(&half), "{half}");
        assert_eq!(of(0.01), 0.25);
    }

    #[test]
    fn few_numbers_change_no_guess() {
        let density = |share: f64| -0.5 * (0.3 / share).powi(2) - share.ln();
        assert_eq!(largest_share(0.125, density), 1.0);
    }
}
