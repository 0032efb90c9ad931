//! Least squares by projection: what columns leave of a reading, and the slope over one channel beside them.

use nalgebra::DVector;

/// The slope of a reading over one channel beside other columns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Partial {
    /// Reading per unit of the channel.
    pub slope: f64,
    /// Squares of what the others leave of the channel.
    pub square: f64,
}

/// Of readings, a channel and other columns, all over the same rows.
pub fn partial(others: &[Vec<f64>], channel: &[f64], reading: &[f64]) -> Partial {
    let basis = orthonormal(others);
    let own = without(&basis, DVector::from_column_slice(channel));
    let square = own.norm_squared().max(f64::MIN_POSITIVE);
    let cross: f64 = own.iter().zip(reading).map(|(o, y)| o * y).sum();
    Partial {
        slope: cross / square,
        square,
    }
}

/// What columns leave of a reading.
pub fn left(columns: &[Vec<f64>], reading: &[f64]) -> Vec<f64> {
    let left = without(&orthonormal(columns), DVector::from_column_slice(reading));
    left.as_slice().to_vec()
}

/// An orthonormal basis of columns; those that depend on others are left out.
pub fn orthonormal(columns: &[Vec<f64>]) -> Vec<DVector<f64>> {
    let mut basis: Vec<DVector<f64>> = Vec::new();
    for column in columns {
        let column = DVector::from_column_slice(column);
        let size = column.norm();
        let column = without(&basis, without(&basis, column));
        if column.norm() > 1e-7 * size && size > 0.0 {
            basis.push(column.normalize());
        }
    }
    basis
}

/// A column less its projection on a basis.
pub fn without(basis: &[DVector<f64>], mut column: DVector<f64>) -> DVector<f64> {
    for b in basis {
        column.axpy(-b.dot(&column), b, 1.0);
    }
    column
}
