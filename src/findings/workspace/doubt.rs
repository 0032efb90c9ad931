//! How far the model is wrong anyway, as rows and the best set of causes have it.

use super::case::Case;
use crate::ground::products::gram;
use crate::inference::doubt::largest_share;
use crate::inference::gaussian::{Products, Reading, evidence};
use nalgebra::DMatrix;

/// Least share of the guess.
const LEAST: f64 = 0.25;
/// Amounts of the causes spread over so many of their priors, so that a large one is not held back.
const WIDE: f64 = 3.0;

impl Case<'_> {
    /// The largest share of the guess that the rows do not contradict, with the best set of causes in it.
    pub(super) fn doubt(&self) -> f64 {
        largest_share(LEAST, |share| self.likelihood(share))
    }

    /// Logarithm of the likelihood of the slopes, springs and causes summed out.
    fn likelihood(&self, share: f64) -> f64 {
        let weighing = self.weighing.tolerating(share);
        let again = |rows: &[f64]| weighing.again(&self.weighing, &rows[..self.slopes()]);
        let rows = again(self.readings.as_slice());
        let causes = self.columns_of(&self.posterior.sets[0].0);
        let springs = self.springs.columns.column_iter();
        let springs = springs.map(|c| again(c.as_slice()));
        let own = causes.iter().map(|c| self.columns.column(*c));
        let own = own.map(|c| again(c.as_slice()));
        let design = DMatrix::from_columns(&springs.chain(own).collect::<Vec<_>>());
        let sizes = causes.iter().map(|c| (1, WIDE * self.field.prior(*c)));
        let springs = [(self.springs.columns.ncols(), self.springs.spread)];
        let blocks: Vec<(usize, f64)> = springs.into_iter().chain(sizes).collect();
        let products = Products {
            gram: gram(&design),
            right: design.tr_mul(&rows),
        };
        let reading = Reading {
            square: rows.norm_squared(),
            rows: rows.len() as f64,
            noise_rows: f64::INFINITY,
        };
        let summed_out = evidence(&products, &reading, &blocks);
        weighing.ln_density() + summed_out.map_or(-0.5 * reading.square, |found| found.1)
    }
}
