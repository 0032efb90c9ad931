//! Errors that many readings share, each of a known standard deviation, taken out of vectors by whitening:
//! (I + AAᵀ)^(-1/2) without a matrix of all readings.

use crate::ground::products::gram;
use nalgebra::{DMatrix, DVector};

/// What whitening takes away: directions of unit length, and the share of each.
#[derive(Debug, Clone, PartialEq)]
pub struct SharedErrors {
    directions: DMatrix<f64>,
    shares: DVector<f64>,
}

/// A direction whose square is below this share of the largest is none.
const FAINT: f64 = 1e-10;

impl SharedErrors {
    /// Of errors, one column each: what one standard deviation of it does to readings whose own noise is one.
    pub fn of(columns: &[Vec<f64>]) -> Option<Self> {
        let rows = columns.first().map_or(0, Vec::len);
        let columns: Vec<DVector<f64>> = columns
            .iter()
            .map(|column| DVector::from_column_slice(column))
            .filter(|column| column.norm_squared().is_normal())
            .collect();
        if columns.is_empty() || rows == 0 {
            return None;
        }
        let all = DMatrix::from_columns(&columns);
        let own = gram(&all).symmetric_eigen();
        let largest = own.eigenvalues.max();
        let kept: Vec<usize> = (0..columns.len())
            .filter(|i| own.eigenvalues[*i] > FAINT * largest)
            .collect();
        let mut directions = &all * own.eigenvectors.select_columns(&kept);
        for (mut direction, i) in directions.column_iter_mut().zip(&kept) {
            direction /= own.eigenvalues[*i].sqrt();
        }
        let share = |i: &usize| 1.0 - (1.0 + own.eigenvalues[*i]).sqrt().recip();
        let shares = DVector::from_iterator(kept.len(), kept.iter().map(share));
        Some(Self { directions, shares })
    }

    /// Whitens readings.
    pub fn whiten(&self, readings: Vec<f64>) -> Vec<f64> {
        let readings = DVector::from_vec(readings);
        let taken = self.directions.tr_mul(&readings);
        let taken = taken.component_mul(&self.shares);
        (readings - &self.directions * taken).as_slice().to_vec()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_whitened_vector_has_the_length_that_its_covariance_gives() {
        let columns = [vec![3.0, 1.0, 0.0, -2.0], vec![0.5, 0.5, 0.5, 0.5]];
        let shared = SharedErrors::of(&columns).unwrap();
        let mut covariance = DMatrix::<f64>::identity(4, 4);
        for column in &columns {
            let column = DVector::from_column_slice(column);
            covariance += &column * column.transpose();
        }
        let readings = vec![1.0, -2.0, 0.3, 4.0];
        let own = DVector::from_vec(readings.clone());
        let expected = own.dot(&(covariance.try_inverse().unwrap() * &own));
        let white = DVector::from_vec(shared.whiten(readings));
        assert!((white.norm_squared() - expected).abs() < 1e-12);
        assert!(SharedErrors::of(&[vec![0.0; 4]]).is_none());
    }
}
