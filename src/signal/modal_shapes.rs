//! Shapes at any number of places by poles that are known, and the few combinations of many responses in
//! which the poles are sought.

use super::modal_fit::Task;
use super::modal_model::Channels;
use super::modal_structure::Structure;
use crate::ground::stats::descending;
use nalgebra::{DMatrix, SymmetricEigen};
use rustfft::num_complex::Complex64;

/// Shapes by poles.
#[derive(Debug, Clone, PartialEq)]
pub struct Shapes {
    /// Per mode, one value per output.
    pub at_outputs: Vec<Vec<Complex64>>,
    /// Per output, the share of its weighted power that the modes leave.
    pub left: Vec<f64>,
}

/// The shapes of the modes at `poles` (1/s, upper half plane), residues of rank one, by linear least squares.
pub fn shapes(channels: &Channels, poles: &[Complex64]) -> Shapes {
    let task = Task::new(channels);
    let outputs = channels.shape.1;
    let empty = Structure {
        poles: Vec::new(),
        shapes: Vec::new(),
        tie: None,
        loose: false,
        outputs,
    };
    let structure = task.with_poles(poles, empty);
    let rest = task.rest(&structure);
    let power = |o: usize, of: &dyn Fn(usize) -> f64| -> f64 {
        (0..channels.shape.0).map(|i| of(i * outputs + o)).sum()
    };
    let left = |o: usize| {
        power(o, &|c| rest[c].norm_squared()) / power(o, &|c| task.target[c].norm_squared())
    };
    Shapes {
        left: (0..outputs).map(left).collect(),
        at_outputs: structure.shapes.into_iter().map(|[at, _]| at).collect(),
    }
}

/// Real combinations of many responses that hold most of their power: `factors[k][output]`, orthonormal, the
/// strongest first, at most `most` (principal response functions; Phillips and Allemang 1993). A mode that
/// moves any output is in them; frequencies and damping are the same in all.
pub fn principal(frf: &[Vec<Complex64>], outputs: usize, most: usize) -> Vec<Vec<f64>> {
    let mut gram = DMatrix::<f64>::zeros(outputs, outputs);
    for input in frf.chunks(outputs) {
        let lines = input.first().map_or(0, Vec::len);
        let part = |im: bool| {
            DMatrix::from_fn(outputs, lines, |o, k| match im {
                true => input[o][k].im,
                false => input[o][k].re,
            })
        };
        for part in [part(false), part(true)] {
            gram += &part * part.transpose();
        }
    }
    let eigen = SymmetricEigen::new(gram);
    let order = descending(eigen.eigenvalues.as_slice());
    let vector = |k: usize| eigen.eigenvectors.column(k).iter().copied().collect();
    order.into_iter().take(most).map(vector).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_motions_need_two_combinations() {
        let line = |k: usize| [(k as f64 * 0.3).sin(), (k as f64 * 0.7).cos()];
        let mix = [[1.0, 0.0], [0.5, 0.5], [0.0, 2.0], [1.0, -1.0]];
        let frf: Vec<Vec<Complex64>> = mix
            .iter()
            .map(|m| {
                let value = |k| Complex64::new(m[0] * line(k)[0], m[1] * line(k)[1]);
                (0..40).map(value).collect()
            })
            .collect();
        let found = principal(&frf, 4, 2);
        for k in 0..40 {
            let whole: f64 = frf.iter().map(|row| row[k].norm_sqr()).sum();
            let seen: f64 = found
                .iter()
                .map(|f| {
                    let sum: Complex64 = f.iter().zip(&frf).map(|(f, row)| row[k] * f).sum();
                    sum.norm_sqr()
                })
                .sum();
            assert!((whole - seen).abs() < 1e-9 * whole.max(1.0));
        }
    }
}
