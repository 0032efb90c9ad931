//! Noise of a probed part: beside a corner a place is worth far less than on a wall.

use crate::findings::engine::Noise;
use crate::ground::stats::quantile;

/// Independent noise of very different size.
pub(super) struct Uneven {
    /// Standard deviation of every row, m.
    pub spread: Vec<f64>,
    /// See [`Noise::rows`].
    pub rows: f64,
}

impl Noise for Uneven {
    fn whiten(&self, column: &[f64]) -> Vec<f64> {
        let each = column.iter().zip(&self.spread);
        each.map(|(c, s)| c / s).collect()
    }

    fn spread(&self) -> &[f64] {
        &self.spread
    }

    fn rows(&self) -> f64 {
        self.rows
    }

    fn weights(&self) -> Vec<f64> {
        vec![quantile(&self.spread, 0.5); self.spread.len()]
    }

    fn describe(&self) -> String {
        "independent from reading to reading".into()
    }
}

/// Whether neighbours know nothing of one another, within two deviations of chance (von Neumann's ratio, 2 for
/// independent numbers with a deviation of 2/√n); numbers in the order of the path.
pub(super) fn is_scatter(courses: &[Vec<f64>]) -> bool {
    let (mut steps, mut squares, mut count) = (0.0, 0.0, 0.0_f64);
    for course in courses {
        let pairs = course.windows(2);
        steps += pairs.map(|p| (p[1] - p[0]).powi(2)).sum::<f64>();
        squares += course.iter().map(|x| x * x).sum::<f64>();
        count += course.len() as f64;
    }
    steps > (2.0 - 4.0 / count.max(1.0).sqrt()) * squares
}

#[cfg(test)]
mod tests {
    use super::is_scatter;
    use crate::ground::random::Random;

    #[test]
    fn noise_scatters_and_a_wave_does_not() {
        let mut random = Random::new(1);
        let noise: Vec<f64> = (0..200).map(|_| random.normal()).collect();
        let wave = noise.iter().enumerate();
        let wave = wave
            .map(|(i, n)| n + 1.5 * (0.1 * i as f64).sin())
            .collect();
        assert!(is_scatter(&[noise]));
        assert!(!is_scatter(&[wave]));
    }
}
