//! The largest eigenvalue of a map that is known by what it does to a vector (Arnoldi 1951).
//!
//! Maps of delay equations are compact: all but a few eigenvalues are next to zero, and a Krylov space of
//! a few dozen vectors holds the largest to the last digits. Where it does not, the space grows until it is
//! the whole one, and the answer exact.

use nalgebra::{Complex, DMatrix, DVector};

/// Vectors of the first space, and by what share it grows: each time a dense problem of its size is solved.
const FIRST: usize = 12;
const MORE: f64 = 1.4;
/// The eigenvalue has settled when growing the space moves it by less than this share.
const SETTLED: f64 = 1e-10;
/// A new vector this much shorter than its map lies within the space.
const WITHIN: f64 = 1e-13;
/// Share by which inverse iteration stands beside an eigenvalue: at it nothing can be solved.
const BESIDE: f64 = 1e-9;

/// The eigenvalue of largest modulus (imaginary part not negative) of a real map of `size` dimensions;
/// `None` where the map gives numbers that are not finite, or has no dimension.
pub fn largest(size: usize, map: impl Fn(&DVector<f64>) -> DVector<f64>) -> Option<Complex<f64>> {
    settled(size, map).map(|found| found.0)
}

/// The same with its vector.
pub fn pair(
    size: usize,
    map: impl Fn(&DVector<f64>) -> DVector<f64>,
) -> Option<(Complex<f64>, DVector<Complex<f64>>)> {
    let (value, space) = settled(size, map)?;
    let vector = space.vector(value)?;
    Some((value, vector))
}

fn settled(
    size: usize,
    map: impl Fn(&DVector<f64>) -> DVector<f64>,
) -> Option<(Complex<f64>, Space)> {
    let mut space = Space::new(size)?;
    let mut before: Option<Complex<f64>> = None;
    let mut aim = FIRST;
    loop {
        let whole = space.grow(aim.min(size), &map)?;
        let value = space.largest()?;
        let settled = before.is_some_and(|b| (value - b).norm() <= SETTLED * value.norm());
        if whole || settled {
            return Some((value, space));
        }
        before = Some(value);
        aim = (MORE * aim as f64) as usize;
    }
}

/// Orthonormal vectors, and the map between them.
struct Space {
    basis: Vec<DVector<f64>>,
    /// One column per vector that was mapped: its parts along the basis.
    columns: Vec<Vec<f64>>,
}

impl Space {
    fn new(size: usize) -> Option<Self> {
        // no direction is left out, and none is favoured
        let start = DVector::from_fn(size, |i, _| 1.0 + 0.5 * (1.0 + 2.3 * i as f64).sin());
        (size > 0).then(|| Self {
            basis: vec![start.normalize()],
            columns: Vec::new(),
        })
    }

    /// Maps vectors until `aim` are; whether nothing lies outside the space any more.
    fn grow(&mut self, aim: usize, map: impl Fn(&DVector<f64>) -> DVector<f64>) -> Option<bool> {
        let size = self.basis[0].len();
        while self.columns.len() < aim {
            let mapped = map(self.basis.last()?);
            let length = mapped.norm();
            if !length.is_finite() {
                return None;
            }
            let (column, rest) = self.split(mapped);
            self.columns.push(column);
            let left = rest.norm();
            if left <= WITHIN * length || self.columns.len() == size {
                return Some(true);
            }
            self.columns.last_mut()?.push(left);
            self.basis.push(rest / left);
        }
        Some(false)
    }

    /// Parts of a vector along the basis, and what is left; twice, since once loses digits.
    fn split(&self, mut vector: DVector<f64>) -> (Vec<f64>, DVector<f64>) {
        let mut parts = vec![0.0; self.basis.len()];
        for _ in 0..2 {
            for (part, own) in parts.iter_mut().zip(&self.basis) {
                let along = own.dot(&vector);
                vector.axpy(-along, own, 1.0);
                *part += along;
            }
        }
        (parts, vector)
    }

    /// The map between the vectors that were mapped.
    fn inner(&self) -> DMatrix<f64> {
        let n = self.columns.len();
        let part = |i: usize, j: usize| self.columns[j].get(i).copied().unwrap_or(0.0);
        DMatrix::from_fn(n, n, part)
    }

    /// The vector of an eigenvalue, by inverse iteration beside it.
    fn vector(&self, value: Complex<f64>) -> Option<DVector<Complex<f64>>> {
        let inner = self.inner().map(Complex::from);
        let n = inner.nrows();
        let beside = value * (1.0 + BESIDE) + Complex::from(f64::MIN_POSITIVE);
        let solved = (inner - DMatrix::identity(n, n) * beside).lu();
        let start = DVector::from_element(n, Complex::new(1.0, 0.0));
        let found = (0..2).try_fold(start, |v, _| Some(solved.solve(&v)?.normalize()))?;
        let zero = DVector::zeros(self.basis[0].len());
        let parts = found.iter().zip(&self.basis);
        Some(parts.fold(zero, |sum, (part, own)| sum + own.map(|x| part * x)))
    }

    fn largest(&self) -> Option<Complex<f64>> {
        let values = self.inner().complex_eigenvalues();
        let found = values.iter().copied();
        let found = found.max_by(|a, b| a.norm().total_cmp(&b.norm()).then(a.im.total_cmp(&b.im)));
        found.map(|v| Complex::new(v.re, v.im.abs()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ground::random::Random;

    fn apart(matrix: &DMatrix<f64>) -> f64 {
        let found = largest(matrix.nrows(), |v| matrix * v).unwrap();
        let all = matrix.complex_eigenvalues();
        let true_size = all.iter().map(|v| v.norm()).fold(0.0, f64::max);
        (found.norm() / true_size - 1.0).abs()
    }

    #[test]
    fn finds_what_the_whole_decomposition_finds() {
        let mut random = Random::new(5);
        for (size, decay) in [(1, 0.5), (2, 0.9), (30, 0.5), (60, 0.8), (40, 1.0)] {
            let weight = |i: i32| f64::powi(decay, i);
            let matrix = DMatrix::from_fn(size, size, |i, _| weight(i as i32) * random.normal());
            assert!(apart(&matrix) < 1e-8, "{size} {decay}: {}", apart(&matrix));
        }
    }

    #[test]
    fn a_value_comes_with_its_vector() {
        let mut random = Random::new(6);
        let matrix = DMatrix::from_fn(30, 30, |i, _| f64::powi(0.8, i as i32) * random.normal());
        let (value, vector) = pair(30, |v| &matrix * v).unwrap();
        let mapped = matrix.map(Complex::from) * &vector;
        assert!((mapped - vector * value).norm() < 1e-6 * value.norm());
    }

    #[test]
    fn a_map_without_numbers_has_none() {
        assert!(largest(3, |v| v * f64::NAN).is_none());
        assert!(largest(0, |v| v.clone()).is_none());
        assert_eq!(largest(3, |v| v * 0.0).unwrap().norm(), 0.0);
    }
}
