//! Noise that grows with the load: a target that turns away, speckle, a rod that bends.

/// Variance of the noise over the square of the load.
pub(super) struct Growth {
    zero: f64,
    slope: f64,
    mean: f64,
}

impl Growth {
    /// Deviation at a square of the load (as a share), in units of the mean one.
    pub fn at(&self, square: f64) -> f64 {
        ((self.zero + self.slope * square) / self.mean).sqrt()
    }
}

/// A growth of the noise is told from chance by this many standard errors ...
const GROWS: f64 = 4.0;
/// ... of at least so many squares; noise at rest is at least this share of the mean.
const SQUARES: usize = 60;
const REST: f64 = 0.05;

/// A line through squares of noise; `None` where they do not grow beyond chance.
pub(super) fn growth(points: &[(f64, f64)]) -> Option<Growth> {
    let n = points.len() as f64;
    let mean = |of: &dyn Fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / n;
    let (x, y) = (mean(&|p| p.0), mean(&|p| p.1));
    let xx = mean(&|p| (p.0 - x).powi(2));
    let slope = mean(&|p| (p.0 - x) * (p.1 - y)) / xx;
    let rest = mean(&|p| (p.1 - y - slope * (p.0 - x)).powi(2));
    let real = points.len() >= SQUARES && slope > GROWS * (rest / xx / n).sqrt();
    let zero = (y - slope * x).max(REST * y);
    (real && y > 0.0).then_some(Growth {
        slope: (y - zero) / x,
        zero,
        mean: y,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ground::random::Random;

    fn squares(rise: f64) -> Vec<(f64, f64)> {
        let mut random = Random::new(3);
        let one = |i: usize| {
            let square = (i % 40) as f64 / 39.0;
            (
                square,
                (random.normal() * (1.0 + rise * square).sqrt()).powi(2),
            )
        };
        (0..4000).map(one).collect()
    }

    #[test]
    fn noise_that_grows_is_told_from_noise_that_does_not() {
        assert!(growth(&squares(0.0)).is_none());
        let found = growth(&squares(8.0)).unwrap();
        let ratio = found.at(1.0) / found.at(0.0);
        assert!((ratio - 3.0).abs() < 0.4, "{ratio}");
    }
}
