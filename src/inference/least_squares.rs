//! Bounded nonlinear least squares: Levenberg and Marquardt (Moré 1978), bounds by projection with an
//! active set. Unknowns are scaled to order one by the problem; a prior is a row like any other.

use crate::ground::products::gram;
use nalgebra::{DMatrix, DVector};

/// What is minimised: ½|residual|² over unknowns of order one.
pub trait Problem {
    /// Reading less model, whitened, at these unknowns.
    fn residual(&self, x: &[f64]) -> DVector<f64>;

    /// The residual, and the slopes of the *model* (−∂residual/∂x), rows × unknowns.
    fn linearise(&self, x: &[f64]) -> (DVector<f64>, DMatrix<f64>);

    /// Lowest and highest value of every unknown; left out: none.
    fn bounds(&self, unknowns: usize) -> Vec<[f64; 2]> {
        vec![[f64::NEG_INFINITY, f64::INFINITY]; unknowns]
    }
}

/// Settings of the descent.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Search {
    /// Most iterations.
    pub iterations: usize,
    /// Relative fall of the sum of squares that counts as arrived.
    pub tolerance: f64,
}

impl Default for Search {
    fn default() -> Self {
        Self {
            iterations: 60,
            tolerance: 1e-9,
        }
    }
}

/// Where a descent ended: the best point that it saw.
#[derive(Debug, Clone)]
pub struct Optimum {
    /// Unknowns.
    pub x: Vec<f64>,
    /// Sum of squares.
    pub chi2: f64,
    /// Which unknowns ended on a bound: −1 lower, +1 upper, 0 free.
    pub active: Vec<i8>,
    /// Slopes of the model there, rows × unknowns.
    pub jacobian: DMatrix<f64>,
    /// Residual there.
    pub residual: DVector<f64>,
    /// Iterations used.
    pub iterations: usize,
}

/// The brake at the start, what a good and a bad step make of it, and where it ends (Marquardt 1963; a
/// cautious fall and a fast rise keep the descent from swinging).
const BRAKE: f64 = 1e-3;
const LOOSEN: f64 = 0.2;
const TIGHTEN: f64 = 6.0;
const LEAST: f64 = 1e-12;
const STUCK: f64 = 1e10;

/// Minimises from `start`.
pub fn minimise(problem: &impl Problem, start: &[f64], search: Search) -> Optimum {
    let bounds = problem.bounds(start.len());
    let mut x = project(start, &bounds);
    let (mut residual, mut jacobian) = problem.linearise(&x);
    let mut chi2 = residual.norm_squared();
    let mut brake = BRAKE;
    let mut iterations = 0;
    while iterations < search.iterations && brake <= STUCK {
        iterations += 1;
        let gradient = jacobian.tr_mul(&residual);
        let free = free_unknowns(&x, &bounds, &gradient);
        let Some(step) = braked_step(&jacobian, &gradient, &free, brake) else {
            break;
        };
        let moved: Vec<f64> = x.iter().zip(step.iter()).map(|(v, d)| v + d).collect();
        let trial = project(&moved, &bounds);
        let after = problem.residual(&trial).norm_squared();
        if after.is_nan() || after >= chi2 {
            brake *= TIGHTEN;
            continue;
        }
        let fall = (chi2 - after) / chi2.max(f64::MIN_POSITIVE);
        x = trial;
        (residual, jacobian) = problem.linearise(&x);
        chi2 = residual.norm_squared();
        brake = (brake * LOOSEN).max(LEAST);
        if fall < search.tolerance {
            break;
        }
    }
    let active = active_bounds(&x, &bounds);
    Optimum {
        x,
        chi2,
        active,
        jacobian,
        residual,
        iterations,
    }
}

fn project(x: &[f64], bounds: &[[f64; 2]]) -> Vec<f64> {
    let within = |(v, b): (&f64, &[f64; 2])| v.max(b[0]).min(b[1]);
    x.iter().zip(bounds).map(within).collect()
}

/// Unknowns that may move: not those on a bound whose descent leads out.
fn free_unknowns(x: &[f64], bounds: &[[f64; 2]], gradient: &DVector<f64>) -> Vec<usize> {
    let held = |j: &usize| {
        (x[*j] <= bounds[*j][0] && gradient[*j] <= 0.0)
            || (x[*j] >= bounds[*j][1] && gradient[*j] >= 0.0)
    };
    (0..x.len()).filter(|j| !held(j)).collect()
}

/// (JᵀJ + λ diag JᵀJ)⁻¹ Jᵀr over the free unknowns; `None` where none is free or nothing is finite.
fn braked_step(
    jacobian: &DMatrix<f64>,
    gradient: &DVector<f64>,
    free: &[usize],
    brake: f64,
) -> Option<DVector<f64>> {
    if free.is_empty() {
        return None;
    }
    let own = jacobian.select_columns(free);
    let mut normal = gram(&own);
    let largest = normal.diagonal().max();
    for j in 0..free.len() {
        normal[(j, j)] += brake * normal[(j, j)].max(1e-12 * largest) + f64::MIN_POSITIVE;
    }
    let right = DVector::from_fn(free.len(), |j, _| gradient[free[j]]);
    let solved = normal.cholesky()?.solve(&right);
    let mut step = DVector::zeros(gradient.len());
    free.iter()
        .zip(solved.iter())
        .for_each(|(j, d)| step[*j] = *d);
    Some(step)
}

fn active_bounds(x: &[f64], bounds: &[[f64; 2]]) -> Vec<i8> {
    let side = |(v, b): (&f64, &[f64; 2])| match () {
        () if *v <= b[0] => -1,
        () if *v >= b[1] => 1,
        () => 0,
    };
    x.iter().zip(bounds).map(side).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rosenbrock's valley (1960), with the first unknown held below `top`.
    struct Valley {
        top: f64,
    }

    impl Problem for Valley {
        fn residual(&self, x: &[f64]) -> DVector<f64> {
            DVector::from_vec(vec![-10.0 * (x[1] - x[0] * x[0]), x[0] - 1.0])
        }

        fn linearise(&self, x: &[f64]) -> (DVector<f64>, DMatrix<f64>) {
            let slopes = DMatrix::from_row_slice(2, 2, &[-20.0 * x[0], 10.0, -1.0, 0.0]);
            (self.residual(x), slopes)
        }

        fn bounds(&self, _: usize) -> Vec<[f64; 2]> {
            vec![[-5.0, self.top], [-5.0, 5.0]]
        }
    }

    #[test]
    fn the_valley_is_walked_to_its_end() {
        let found = minimise(&Valley { top: 5.0 }, &[-1.2, 1.0], Search::default());
        assert!((found.x[0] - 1.0).abs() < 1e-6 && (found.x[1] - 1.0).abs() < 1e-6);
    }

    #[test]
    fn a_bound_holds() {
        let found = minimise(&Valley { top: 0.5 }, &[-1.2, 1.0], Search::default());
        assert_eq!(found.active, [1, 0]);
        assert!((found.x[1] - 0.25).abs() < 1e-6);
    }
}
