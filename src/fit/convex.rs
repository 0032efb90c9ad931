//! Small convex programmes: a quadratic over non-negative numbers (Clarabel; Goulart and Chen 2024).

use crate::ground::problem::{Outcome, Problem};
use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, NonnegativeConeT, SolverStatus};
use nalgebra::{DMatrix, DVector};

/// A minimum over non-negative numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Minimum {
    /// Where it lies; zero exactly where the bound holds it.
    pub x: DVector<f64>,
    /// Which numbers are free of the bound.
    pub free: Vec<bool>,
}

/// Below this share of its scale a number counts as held by the bound.
const HELD: f64 = 1e-6;

/// Minimises ½ xᵀHx − gᵀx over x ≥ 0, with H positive definite and x of order one. The interior-point
/// solution names the numbers at the bound; the others are then solved for exactly.
///
/// # Errors
/// No convergence: H is not positive definite or holds numbers that are not finite.
pub fn non_negative(hessian: &DMatrix<f64>, gradient: &DVector<f64>) -> Outcome<Minimum> {
    let refuse = |why: String| {
        Problem::new(
            format!("the compliances cannot be fitted ({why})"),
            "check the measurement for values that are far out of scale",
        )
    };
    let n = gradient.len();
    let scale = hessian
        .diagonal()
        .map(|d| 1.0 / d.max(f64::MIN_POSITIVE).sqrt());
    let rows = |i: usize| {
        (0..n)
            .map(|j| hessian[(i, j)] * scale[i] * scale[j])
            .collect::<Vec<f64>>()
    };
    let dense: Vec<Vec<f64>> = (0..n).map(rows).collect();
    let upper = CscMatrix::from(dense.iter().map(Vec::as_slice)).to_triu();
    let linear: Vec<f64> = (0..n).map(|i| -gradient[i] * scale[i]).collect();
    let constraint = CscMatrix::new(n, n, (0..=n).collect(), (0..n).collect(), vec![-1.0; n]);
    let settings = DefaultSettings {
        verbose: false,
        ..DefaultSettings::default()
    };
    let cones = [NonnegativeConeT(n)];
    let solver = DefaultSolver::new(
        &upper,
        &linear,
        &constraint,
        &vec![0.0; n],
        &cones,
        settings,
    );
    let mut solver = solver.map_err(|e| refuse(e.to_string()))?;
    solver.solve();
    match solver.solution.status {
        SolverStatus::Solved | SolverStatus::AlmostSolved => {}
        other => return Err(refuse(other.to_string())),
    }
    let free: Vec<bool> = (0..n)
        .map(|i| solver.solution.x[i] * scale[i] > HELD)
        .collect();
    let x = among(hessian, gradient, &free).ok_or_else(|| refuse("singular".into()))?;
    Ok(Minimum { x, free })
}

/// The minimum with the numbers that are not free held at zero.
fn among(hessian: &DMatrix<f64>, gradient: &DVector<f64>, free: &[bool]) -> Option<DVector<f64>> {
    let index: Vec<usize> = (0..free.len()).filter(|i| free[*i]).collect();
    let inner = hessian.select_rows(&index).select_columns(&index);
    let right = DVector::from_fn(index.len(), |a, _| gradient[index[a]]);
    let solved = inner.cholesky()?.solve(&right);
    let mut x = DVector::zeros(free.len());
    index
        .iter()
        .zip(solved.iter())
        .for_each(|(i, value)| x[*i] = *value);
    Some(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bound_holds_what_would_be_negative() {
        let hessian = DMatrix::from_row_slice(2, 2, &[2.0, 1.0, 1.0, 2.0]);
        let minimum = non_negative(&hessian, &DVector::from_vec(vec![2.0, -1.0])).unwrap();
        assert_eq!(minimum.free, [true, false]);
        assert!((minimum.x[0] - 1.0).abs() < 1e-12 && minimum.x[1] == 0.0);
    }
}
