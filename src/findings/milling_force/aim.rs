//! How far a single cause would have to go: its amounts beside what is merely uncertain, by weighted least
//! squares. Causes that are not linear are taken as the way from nothing to there (a secant).

use super::Case;
use crate::findings::engine::Nuisance;
use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

/// The reading and the nuisances in noise deviations.
pub struct Aim {
    nuisances: DMatrix<f64>,
    root: Option<Cholesky<f64, Dyn>>,
    reading: DVector<f64>,
    spread: Vec<f64>,
}

/// Rounds in which a secant is improved.
const ROUNDS: usize = 4;

impl Aim {
    /// Of a case.
    pub fn new(case: &Case, nuisances: &[Nuisance]) -> Self {
        let spread = case.column(|_, _, k| case.noise()[k]);
        let columns: Vec<DVector<f64>> = nuisances
            .iter()
            .map(|n| white(&n.column, &spread))
            .collect();
        let nuisance = match columns.is_empty() {
            true => DMatrix::zeros(spread.len(), 0),
            false => DMatrix::from_columns(&columns),
        };
        let mut inner = nuisance.tr_mul(&nuisance);
        for (k, n) in nuisances.iter().enumerate() {
            inner[(k, k)] += (n.spread * n.spread).recip() + 1e-10 * inner[(k, k)];
        }
        Self {
            root: inner.cholesky(),
            nuisances: nuisance,
            reading: white(&case.reading(), &spread),
            spread,
        }
    }

    /// What the nuisances leave of a whitened column.
    fn free(&self, column: &DVector<f64>) -> DVector<f64> {
        let seen = self.nuisances.tr_mul(column);
        match &self.root {
            Some(root) => column - &self.nuisances * root.solve(&seen),
            None => column.clone(),
        }
    }

    /// Amounts of some columns together; zeros where they show nothing.
    pub fn amounts(&self, columns: &[Vec<f64>]) -> Vec<f64> {
        let own: Vec<DVector<f64>> = columns.iter().map(|c| white(c, &self.spread)).collect();
        let (matrix, free) = (
            DMatrix::from_columns(&own),
            DMatrix::from_columns(&own.iter().map(|c| self.free(c)).collect::<Vec<_>>()),
        );
        let mut inner = matrix.tr_mul(&free);
        (0..own.len()).for_each(|i| inner[(i, i)] *= 1.0 + 1e-9);
        let right = free.tr_mul(&self.reading);
        let solved = inner.cholesky().map(|root| root.solve(&right));
        solved.map_or(vec![0.0; own.len()], |s| s.as_slice().to_vec())
    }

    /// By how much one column lowers the misfit, nats.
    pub fn gain(&self, column: &[f64]) -> f64 {
        let own = white(column, &self.spread);
        let free = self.free(&own);
        let (pull, square) = (free.dot(&self.reading), free.dot(&own));
        match square > 1e-9 * own.norm_squared() {
            true => 0.5 * pull * pull / square,
            false => 0.0,
        }
    }

    /// The column of a direction of the vector as the way to where it fits best, at most `most` far.
    pub fn secant(&self, case: &Case, direction: &[f64], most: f64) -> Vec<f64> {
        let mut column = case.along(direction);
        if column.iter().all(|x| *x == 0.0) {
            return column;
        }
        for _ in 0..ROUNDS {
            let amount = self.amounts(std::slice::from_ref(&column))[0].clamp(-most, most);
            if amount.abs() < 1e-3 * most {
                break;
            }
            column = case.way(direction, amount);
        }
        column
    }
}

fn white(column: &[f64], spread: &[f64]) -> DVector<f64> {
    let each = column.iter().zip(spread).map(|(c, s)| c / s);
    DVector::from_iterator(column.len(), each)
}
