//! The noise of the readings, as a kind of measurement states it.

/// The noise of the readings.
pub trait Noise: Send + Sync {
    /// A column (one entry per row, in the unit of the readings) in independent noise deviations. Linear,
    /// and as many numbers as rows.
    fn whiten(&self, column: &[f64]) -> Vec<f64>;
    /// Standard deviation of every row, in the unit of the readings.
    fn spread(&self) -> &[f64];
    /// Rows that the stated deviations are worth: 0 where they are only relative to one another, infinite
    /// where they are certain.
    fn rows(&self) -> f64;
    /// The unit in which the error of every reading enters a gain: that of the readings, or, where these differ much
    /// in what they are worth, noise deviations times that of a typical one.
    fn weights(&self) -> Vec<f64> {
        self.spread().to_vec()
    }
    /// In words, as in "the noise is white".
    fn describe(&self) -> String;
}

/// Independent noise.
#[derive(Debug, Clone, PartialEq)]
pub struct White {
    /// Standard deviation of every row, in the unit of the readings, above zero.
    pub spread: Vec<f64>,
    /// See [`Noise::rows`].
    pub rows: f64,
}

impl Noise for White {
    fn whiten(&self, column: &[f64]) -> Vec<f64> {
        column
            .iter()
            .zip(&self.spread)
            .map(|(c, s)| c / s)
            .collect()
    }

    fn spread(&self) -> &[f64] {
        &self.spread
    }

    fn rows(&self) -> f64 {
        self.rows
    }

    fn describe(&self) -> String {
        "independent from reading to reading".into()
    }
}
