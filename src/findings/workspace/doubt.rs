//! How far the model is wrong anyway. What is put up with is a guess before the data; rows that agree far better with a set of
//! causes show it to be too large, and what is hidden below it becomes visible.

use super::case::Case;
use nalgebra::{DMatrix, DVector};

/// Shares of the guess that are tried.
const SHARES: [f64; 9] = [1.0, 0.84, 0.71, 0.59, 0.5, 0.42, 0.35, 0.3, 0.25];
/// Nats below the likeliest share at which one is contradicted: half the square of 1.96 deviations.
const CONTRADICTED: f64 = 1.92;
/// Amounts of the causes spread over so many of their priors, so that a large one is not held back.
const WIDE: f64 = 3.0;

impl Case<'_> {
    /// The largest share of the guess that the rows do not contradict, with the best set of causes in it.
    pub(super) fn doubt(&self) -> f64 {
        let all = SHARES.map(|share| self.likelihood(share));
        let best = all.iter().copied().fold(f64::MIN, f64::max);
        let fits = all.iter().position(|l| *l >= best - CONTRADICTED);
        fits.map_or(1.0, |at| SHARES[at])
    }

    /// Logarithm of the likelihood of the slopes, springs and causes summed out.
    fn likelihood(&self, share: f64) -> f64 {
        let weighing = self.weighing.tolerating(share);
        let again = |rows: &[f64]| weighing.again(&self.weighing, &rows[..self.slopes()]);
        let rows = again(self.readings.as_slice());
        let springs = self.springs.columns.column_iter();
        let springs = springs.map(|c| again(c.as_slice()) * self.springs.spread);
        let causes = self.columns_of(&self.posterior.sets[0].0).into_iter();
        let causes =
            causes.map(|c| again(self.columns.column(c).as_slice()) * (WIDE * self.field.prior(c)));
        let all: Vec<DVector<f64>> = springs.chain(causes).collect();
        weighing.ln_density() - 0.5 * summed_out(&rows, &DMatrix::from_columns(&all))
    }
}

/// Squares of rows and logarithm of the determinant, amounts of unit variance summed out.
fn summed_out(rows: &DVector<f64>, design: &DMatrix<f64>) -> f64 {
    let mut inner = design.tr_mul(design);
    (0..inner.nrows()).for_each(|i| inner[(i, i)] += 1.0);
    let squares = rows.norm_squared();
    inner.cholesky().map_or(squares, |root| {
        let right = design.tr_mul(rows);
        squares - right.dot(&root.solve(&right)) + root.ln_determinant()
    })
}

#[cfg(test)]
mod tests {
    use super::summed_out;
    use nalgebra::{DMatrix, DVector};

    #[test]
    fn amounts_summed_out_are_a_covariance() {
        let design = DMatrix::from_column_slice(3, 1, &[1.0, -2.0, 0.5]);
        let rows = DVector::from_column_slice(&[0.3, 1.0, -0.7]);
        let root = (&design * design.transpose() + DMatrix::identity(3, 3)).cholesky();
        let root = root.expect("positive");
        let wanted = rows.dot(&root.solve(&rows)) + root.ln_determinant();
        assert!((summed_out(&rows, &design) - wanted).abs() < 1e-12);
    }
}
