//! Products with a transposed matrix through the kernel for matrices: a product of columns one by one takes
//! many times as long.

use nalgebra::DMatrix;

/// `aᵀb`.
pub fn transposed(a: &DMatrix<f64>, b: &DMatrix<f64>) -> DMatrix<f64> {
    a.transpose() * b
}

/// `aᵀa`.
pub fn gram(a: &DMatrix<f64>) -> DMatrix<f64> {
    transposed(a, a)
}
