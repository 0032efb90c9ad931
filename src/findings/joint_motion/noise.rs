//! Noise first: what a generous span of everything cannot explain, and its colour.

use super::channels::Channels;
use super::columns::{Atom, base, range};
use crate::signal::colour::Colour;
use crate::signal::cosine::Cosine;
use nalgebra::{DMatrix, DVector};

/// Slow functions of time in the span.
const SLOW: usize = 8;
/// Powers of the angle, of the torque and of the speed.
const POWERS: i32 = 4;

/// The noise of a joint's record.
pub struct Noise {
    /// Its colour.
    pub colour: Colour,
    /// Whitened sum of squares that the span leaves.
    pub saturated: f64,
    /// Dimension of the span.
    pub dimension: usize,
    /// The planned transform.
    pub cosine: Cosine,
}

impl Noise {
    /// From the readings and every candidate.
    pub fn of(data: &Channels, atoms: &[Atom]) -> Self {
        let cosine = Cosine::new(data.rows());
        let reading = transformed(&cosine, &data.twist);
        let span: Vec<Vec<f64>> = span(data, atoms)
            .iter()
            .map(|c| transformed(&cosine, c))
            .collect();
        let mut colour = Colour::white(data.rows(), 1.0);
        for _pass in 0..2 {
            let (basis, left) = project(&span, &reading, &colour);
            let free: Vec<f64> = (0..data.rows())
                .map(|k| (1.0 - basis.row(k).norm_squared()).max(0.0))
                .collect();
            let left: Vec<f64> = left.iter().zip(&colour.sigma).map(|(r, s)| r * s).collect();
            colour = floored(Colour::estimate(&left, &free));
        }
        let (basis, left) = project(&span, &reading, &colour);
        Self {
            colour,
            saturated: left.norm_squared(),
            dimension: basis.ncols(),
            cosine,
        }
    }

    /// A column in the domain where the noise is white.
    pub fn whiten(&self, column: &[f64]) -> DVector<f64> {
        let mut column = transformed(&self.cosine, column);
        self.colour.whiten(&mut column);
        DVector::from_vec(column)
    }
}

/// Readings without any noise leave nothing to divide by.
fn floored(mut colour: Colour) -> Colour {
    colour.sigma.iter_mut().for_each(|s| *s = s.max(1e-12));
    colour
}

fn transformed(cosine: &Cosine, column: &[f64]) -> Vec<f64> {
    let mut column = column.to_vec();
    cosine.transform(&mut column);
    column
}

fn span(data: &Channels, atoms: &[Atom]) -> Vec<Vec<f64>> {
    let mut span = base(data);
    span.extend(atoms.iter().flat_map(|a| a.columns.iter().cloned()));
    for channel in [&data.motor, &data.torque, &data.speed, &data.acceleration] {
        let (low, high) = range(channel);
        let x = |v: &f64| (2.0 * v - low - high) / (high - low).max(f64::MIN_POSITIVE);
        span.extend((2..=POWERS).map(|p| channel.iter().map(|v| x(v).powi(p)).collect()));
    }
    let n = data.rows() as f64;
    let slow = |k: usize| {
        let wave = |i: usize| (std::f64::consts::PI * k as f64 * (i as f64 + 0.5) / n).cos();
        (0..data.rows()).map(wave).collect()
    };
    span.extend((1..=SLOW).map(slow));
    span
}

/// An orthonormal basis of the whitened span, and what it leaves of the whitened reading.
fn project(span: &[Vec<f64>], reading: &[f64], colour: &Colour) -> (DMatrix<f64>, DVector<f64>) {
    let white = |c: &[f64]| {
        let mut c = c.to_vec();
        colour.whiten(&mut c);
        DVector::from_vec(c)
    };
    let basis = orthonormal(span.iter().map(|c| white(c)).collect());
    let left = without(&basis, white(reading));
    (DMatrix::from_columns(&basis), left)
}

/// An orthonormal basis of columns; those that depend on others are left out.
pub fn orthonormal(columns: Vec<DVector<f64>>) -> Vec<DVector<f64>> {
    let mut basis: Vec<DVector<f64>> = Vec::new();
    for column in columns {
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
