//! Shapes from poles: free residues by linear least squares, then their nearest matrix of rank one.

use super::modal_fit::Task;
use super::modal_model::Channels;
use super::modal_structure::Structure;
use nalgebra::{DMatrix, DVector};
use rustfft::num_complex::Complex64;

/// Rounds of the power iteration: the second singular value need not be gone, only small.
const ROUNDS: usize = 30;

impl Task<'_> {
    /// A structure without modes; reciprocal where every input has its output.
    pub fn empty(&self) -> Structure {
        let tie = tie(self.channels);
        Structure {
            poles: Vec::new(),
            shapes: Vec::new(),
            loose: tie.is_some(),
            tie,
            outputs: self.channels.shape.1,
        }
    }

    /// The modes at `poles`, with the shapes that suit best.
    pub fn with_poles(&self, poles: &[Complex64], empty: Structure) -> Structure {
        let residues = self.residues(poles);
        let modes = poles.iter().zip(residues);
        modes.fold(empty, |structure, (pole, residue)| {
            let shape = structure.shape(&residue);
            structure.with(*pole, shape)
        })
    }

    /// Free residues of modes at `poles`: `[mode][channel]`.
    fn residues(&self, poles: &[Complex64]) -> Vec<Vec<Complex64>> {
        let of_poles = self.columns(poles);
        let of = |c: usize| {
            let basis = self.basis(c, &of_poles, false);
            solved(
                &(basis.transpose() * &basis),
                &basis.tr_mul(&self.target[c]),
            )
        };
        let channels: Vec<DVector<f64>> = (0..self.target.len()).map(of).collect();
        let one = |r: usize| {
            let part = |x: &DVector<f64>| Complex64::new(x[2 * r], x[2 * r + 1]);
            channels.iter().map(part).collect()
        };
        (0..poles.len()).map(one).collect()
    }
}

/// `gram⁻¹·slope`, with a little weight on small unknowns where poles are too close to tell.
fn solved(gram: &DMatrix<f64>, slope: &DVector<f64>) -> DVector<f64> {
    let mut raised = gram.clone();
    for i in 0..raised.nrows() {
        raised[(i, i)] = raised[(i, i)].max(1e-300) * (1.0 + 1e-9);
    }
    let factor = raised.cholesky();
    factor.map_or_else(|| DVector::zeros(slope.len()), |f| f.solve(slope))
}

/// T with the gains alone, `H[o][i]/H[i][o]` against the first output, and which output each input
/// drives; none unless there are as many inputs as outputs, and more than one.
fn tie(channels: &Channels) -> Option<(DMatrix<f64>, Vec<usize>)> {
    let driven = channels.driven.clone().filter(|driven| driven.len() > 1)?;
    let outputs = channels.shape.1;
    let input = |o: usize| driven.iter().position(|d| *d == o);
    let first = input(0)?;
    let gain = |o: usize| {
        let there = &channels.frf[first * outputs + o];
        let back = &channels.frf[input(o)? * outputs];
        let cross: f64 = there.iter().zip(back).map(|(a, b)| (a * b.conj()).re).sum();
        let power: f64 = back.iter().map(|b| b.norm_sqr()).sum();
        let gain = cross / power;
        (gain.is_finite() && gain != 0.0).then(|| gain.signum() * gain.abs().clamp(0.2, 5.0))
    };
    let gains: Option<Vec<f64>> = (0..outputs).map(gain).collect();
    let mixing = DMatrix::from_diagonal(&DVector::from_vec(gains?));
    Some((mixing, driven))
}

impl Structure {
    /// The shape nearest to residues per channel.
    pub fn shape(&self, residue: &[Complex64]) -> [Vec<Complex64>; 2] {
        let inputs = residue.len() / self.outputs;
        let free = DMatrix::from_fn(self.outputs, inputs, |o, i| residue[i * self.outputs + o]);
        let Some((mixing, driven)) = &self.tie else {
            let (left, right) = rank_one(&free);
            return [left, right];
        };
        let unmixed = mixing
            .clone()
            .try_inverse()
            .unwrap_or_else(|| mixing.clone());
        let unmixed = unmixed.map(|v| Complex64::new(v, 0.0)) * free;
        let mut square = unmixed.clone();
        for (i, m) in driven.iter().enumerate() {
            square.set_column(*m, &unmixed.column(i));
        }
        let symmetric = (&square + square.transpose()) * Complex64::new(0.5, 0.0);
        [reciprocal(&symmetric), Vec::new()]
    }
}

/// `left·rightᵀ` nearest to a matrix; both of the same size.
fn rank_one(matrix: &DMatrix<Complex64>) -> (Vec<Complex64>, Vec<Complex64>) {
    let left = leading(matrix);
    let right = matrix.transpose() * left.map(|v| v.conj());
    let scale = right.norm().sqrt();
    let left: Vec<Complex64> = left.iter().map(|v| v * scale).collect();
    let right = right.iter().map(|v| v / scale.max(1e-300)).collect();
    (left, right)
}

/// `ψ` with `ψ·ψᵀ` nearest to a symmetric matrix.
fn reciprocal(matrix: &DMatrix<Complex64>) -> Vec<Complex64> {
    let left = leading(matrix);
    let back = matrix * left.map(|v| v.conj());
    let size = left.dotc(&back);
    left.iter().map(|v| v * size.sqrt()).collect()
}

/// The leading left singular vector.
fn leading(matrix: &DMatrix<Complex64>) -> DVector<Complex64> {
    let square = matrix * matrix.adjoint();
    let strongest = (0..square.ncols()).max_by(|a, b| {
        let size = |k: usize| square[(k, k)].re;
        size(*a).total_cmp(&size(*b))
    });
    let mut vector = square.column(strongest.unwrap_or(0)).into_owned();
    for _ in 0..ROUNDS {
        let norm = vector.norm();
        if !(norm > 0.0 && norm.is_finite()) {
            return DVector::zeros(matrix.nrows());
        }
        vector = &square * (vector / Complex64::new(norm, 0.0));
    }
    let norm = vector.norm().max(1e-300);
    vector / Complex64::new(norm, 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_are_found_again() {
        let c = Complex64::new;
        let (u, v) = (
            [c(1.0, 0.5), c(-0.3, 0.2)],
            [c(0.4, -1.0), c(2.0, 0.0), c(0.1, 0.7)],
        );
        let matrix = DMatrix::from_fn(2, 3, |o, i| u[o] * v[i]);
        let (left, right) = rank_one(&matrix);
        let again = DMatrix::from_fn(2, 3, |o, i| left[o] * right[i]);
        assert!((again - matrix).norm() < 1e-12);
        let square = DMatrix::from_fn(3, 3, |o, i| v[o] * v[i]);
        let shape = reciprocal(&square);
        let again = DMatrix::from_fn(3, 3, |o, i| shape[o] * shape[i]);
        assert!((again - square).norm() < 1e-12);
    }
}
