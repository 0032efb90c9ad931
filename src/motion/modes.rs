//! Natural modes: undamped, and complex with damping.

use super::linear::Linear;
use crate::ground::cholesky;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::V3;
use crate::ground::stats::descending;
use nalgebra::{Complex, DMatrix, DVector};
use std::f64::consts::TAU;

/// The system in its undamped modes, scaled to unit stiffness: μ ẍ + D̂ ẋ + x = Ĵᵀ f. Exact: nothing
/// is truncated, D̂ keeps its off-diagonal part, and coordinates without mass (two springs in a row
/// with nothing between them) stay in it with μ = 0.
#[derive(Debug, Clone)]
pub struct Modal {
    /// Number of modes.
    pub n: usize,
    /// μ = 1/ω²: inverse squared undamped circular frequencies, s², descending.
    pub inertia: Vec<f64>,
    /// Φ: modes in columns, n×n by rows, ΦᵀKΦ = 1.
    pub shape: Vec<f64>,
    /// D̂ = ΦᵀDΦ, s, n×n by rows.
    pub damping: Vec<f64>,
    /// Translation of the tool per modal coordinate, base axes.
    pub tool: Vec<V3>,
}

/// One mode of vibration.
#[derive(Debug, Clone, PartialEq)]
pub struct Mode {
    /// |λ|/2π, Hz.
    pub frequency_hz: f64,
    /// −Re λ/|λ|; 1 for a mode that does not swing.
    pub damping_ratio: f64,
    /// Elastic coordinates, largest scaled to 1, real part after that scaling.
    pub shape: Vec<f64>,
    /// Translation of the tool in this mode, same scaling, m, base axes.
    pub tool: V3,
}

/// Modes slower in 1/ω² than this share of the slowest count as massless.
const MASSLESS: f64 = 1e-13;

/// Undamped modes from the flexibility side: F⁻¹MF⁻ᵀ y = y/ω² with K = FFᵀ, so that the low modes,
/// which matter, keep all their digits beside the virtual axes' very high ones.
///
/// # Errors
/// A stiffness matrix that is not positive definite.
pub fn modal(linear: &Linear) -> Outcome<Modal> {
    let n = linear.n;
    let mut factor = linear.stiffness.clone();
    if !cholesky::factor(&mut factor, n) {
        return Err(Problem::new(
            "the stiffness matrix is not positive definite",
            "every spring needs a positive stiffness",
        ));
    }
    let lower = DMatrix::from_row_slice(n, n, &factor).lower_triangle();
    let eigen = flexible_mass(linear, &factor).symmetric_eigen();
    let order = descending(eigen.eigenvalues.as_slice());
    let least = MASSLESS * order.first().map_or(0.0, |i| eigen.eigenvalues[*i]);
    let inertia = order
        .iter()
        .map(|i| eigen.eigenvalues[*i])
        .map(|mu| if mu > least { mu } else { 0.0 });
    let sorted = eigen.eigenvectors.select_columns(&order);
    let shape = lower.tr_solve_lower_triangular(&sorted).unwrap_or(sorted);
    Ok(assemble(linear, inertia.collect(), &shape))
}

/// F⁻¹ M F⁻ᵀ
fn flexible_mass(linear: &Linear, factor: &[f64]) -> DMatrix<f64> {
    let n = linear.n;
    let halve = |mut matrix: DMatrix<f64>| {
        matrix
            .column_iter_mut()
            .for_each(|mut column| cholesky::forward(factor, n, column.as_mut_slice()));
        matrix.transpose()
    };
    halve(halve(DMatrix::from_row_slice(n, n, &linear.mass)))
}

fn assemble(linear: &Linear, inertia: Vec<f64>, shape: &DMatrix<f64>) -> Modal {
    let n = linear.n;
    let damping = DMatrix::from_row_slice(n, n, &linear.damping);
    let damping = shape.tr_mul(&(damping * shape));
    let tool = |mode: usize| {
        [0, 1, 2].map(|axis| {
            (0..n)
                .map(|i| linear.tool[i][axis] * shape[(i, mode)])
                .sum()
        })
    };
    Modal {
        n,
        inertia,
        shape: shape.transpose().as_slice().to_vec(),
        damping: damping.as_slice().to_vec(),
        tool: (0..n).map(tool).collect(),
    }
}

/// Damped modes, by ascending frequency; of each conjugate pair the one with positive frequency.
pub fn complex_modes(linear: &Linear, modal: &Modal) -> Vec<Mode> {
    let roots = eigenvalues(modal);
    let mut roots: Vec<Complex<f64>> = roots.into_iter().filter(|root| root.im >= 0.0).collect();
    roots.sort_by(|a, b| a.norm().total_cmp(&b.norm()).then(a.im.total_cmp(&b.im)));
    roots
        .iter()
        .map(|root| mode(linear, modal, *root))
        .collect()
}

/// Roots s of det(s²μ + s D̂ + 1), found as 1/s: large where the frequency is low.
fn eigenvalues(modal: &Modal) -> Vec<Complex<f64>> {
    let n = modal.n;
    let tau: Vec<f64> = modal.inertia.iter().map(|mu| mu.sqrt()).collect();
    let inverse: Vec<Complex<f64>> = if off_diagonal(modal) < PROPORTIONAL {
        (0..n)
            .flat_map(|i| single(tau[i], modal.damping[i * n + i]))
            .collect()
    } else {
        state_matrix(modal, &tau)
            .complex_eigenvalues()
            .iter()
            .copied()
            .collect()
    };
    let slowest = inverse.iter().map(|t| t.norm()).fold(0.0, f64::max);
    let finite = inverse.into_iter().filter(|t| t.norm() > 1e-9 * slowest);
    finite.map(|t| 1.0 / t).collect()
}

/// First-order form of t² + t D̂ + τ² with t = 1/s.
fn state_matrix(modal: &Modal, tau: &[f64]) -> DMatrix<f64> {
    let n = modal.n;
    DMatrix::from_fn(2 * n, 2 * n, |i, j| match (i < n, j < n) {
        (true, false) if i == j - n => tau[i],
        (false, true) if i - n == j => -tau[j],
        (false, false) => -modal.damping[(i - n) * n + j - n],
        _ => 0.0,
    })
}

/// Both roots t of t² + d t + τ².
fn single(tau: f64, d: f64) -> [Complex<f64>; 2] {
    let root = Complex::new(0.25 * d * d - tau * tau, 0.0).sqrt();
    [root - 0.5 * d, -root - 0.5 * d]
}

/// Coupling below which damping counts as proportional: rounding of ΦᵀDΦ.
pub(super) const PROPORTIONAL: f64 = 1e-12;

/// Largest off-diagonal damping against the diagonal: 0 for proportional damping.
pub(super) fn off_diagonal(modal: &Modal) -> f64 {
    let n = modal.n;
    let entry = |i: usize, j: usize| modal.damping[i * n + j];
    let pairs = (0..n).flat_map(|i| (0..i).map(move |j| (i, j)));
    let share = |(i, j): (usize, usize)| {
        entry(i, j).abs() / (entry(i, i) * entry(j, j)).sqrt().max(f64::MIN_POSITIVE)
    };
    pairs.map(share).fold(0.0, f64::max)
}

/// The mode of a root: null vector of s²μ + s D̂ + 1 by two steps of inverse iteration.
fn mode(linear: &Linear, modal: &Modal, root: Complex<f64>) -> Mode {
    let n = modal.n;
    let gap = |i: usize| (modal.inertia[i].sqrt() - 1.0 / root.norm()).abs();
    let start = (0..n).min_by(|a, b| gap(*a).total_cmp(&gap(*b)));
    let s = root * (1.0 + 1e-10);
    let matrix = DMatrix::from_fn(n, n, |i, j| {
        let own = if i == j {
            s * s * modal.inertia[i] + 1.0
        } else {
            Complex::new(0.0, 0.0)
        };
        own + s * modal.damping[i * n + j]
    });
    let unit = |i: usize| Complex::new(if Some(i) == start { 1.0 } else { 0.0 }, 0.0);
    let mut vector = DVector::from_fn(n, |i, _| unit(i));
    let lu = matrix.lu();
    for _ in 0..2 {
        let next = lu.solve(&vector).map(|v| v.unscale(v.norm()));
        vector = next
            .filter(|v| v.iter().all(|x| x.is_finite()))
            .unwrap_or(vector);
    }
    let spread = |i: usize| {
        (0..n)
            .map(|m| vector[m] * modal.shape[i * n + m])
            .sum::<Complex<f64>>()
    };
    report(linear, root, &(0..n).map(spread).collect::<Vec<_>>())
}

fn report(linear: &Linear, root: Complex<f64>, shape: &[Complex<f64>]) -> Mode {
    let largest = shape
        .iter()
        .copied()
        .max_by(|a, b| a.norm().total_cmp(&b.norm()));
    let scale = largest
        .filter(|x| x.norm() > 0.0)
        .unwrap_or(Complex::new(1.0, 0.0));
    let shape: Vec<f64> = shape.iter().map(|x| (x / scale).re).collect();
    let tool = [0, 1, 2].map(|axis| {
        shape
            .iter()
            .zip(&linear.tool)
            .map(|(x, j)| x * j[axis])
            .sum()
    });
    Mode {
        frequency_hz: root.norm() / TAU,
        damping_ratio: -root.re / root.norm(),
        shape,
        tool,
    }
}
