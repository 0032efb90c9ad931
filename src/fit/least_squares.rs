//! Bounded weighted nonlinear least squares of a composite of effects.
//!
//! Levenberg–Marquardt (Moré 1978) on whitened residuals in the cosine domain, parameters scaled by
//! their natural scale, bounds by projection with an active set. Derivatives by dual numbers.

use super::observation::Observation;
use crate::effects::Composite;
use crate::signal::colour::Colour;
use nalgebra::{DMatrix, DVector};

/// Where a fit ended.
#[derive(Debug, Clone)]
pub struct Optimum {
    /// Parameters, SI.
    pub p: Vec<f64>,
    /// Whitened sum of squares.
    pub chi2: f64,
    /// Which parameters ended on a bound: −1 lower, +1 upper, 0 free.
    pub active: Vec<i8>,
    /// Jacobian of the whitened residual with respect to scaled parameters, rows × parameters.
    pub jacobian: DMatrix<f64>,
    /// Whitened residual, reading less model.
    pub residual: DVector<f64>,
    /// Scales of the parameters.
    pub scale: Vec<f64>,
    /// Iterations used.
    pub iterations: usize,
}

/// Settings of the search.
#[derive(Debug, Clone, Copy)]
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

/// The whitened problem: model, data and noise.
pub struct Problem<'a> {
    /// Model.
    pub model: &'a Composite,
    /// Data.
    pub data: &'a Observation,
    /// Noise.
    pub colour: &'a Colour,
    /// Rows whose readings do not count (held-out cycles, wild readings): replaced by the model.
    pub ignored: &'a [bool],
}

impl Problem<'_> {
    /// Natural sizes of the parameters, SI.
    pub fn scale(&self) -> Vec<f64> {
        let slots = self.model.slots();
        let each = slots.iter().map(|s| s.parameter.scale.of(&self.data.scene));
        each.collect()
    }

    fn weigh(&self, residual: &mut [f64]) {
        for (r, ignored) in residual.iter_mut().zip(self.ignored) {
            if *ignored {
                *r = 0.0;
            }
        }
        self.data.cosine.transform(residual);
        self.colour.whiten(residual);
    }

    /// Whitened residual (reading − model).
    pub fn residual(&self, p: &[f64]) -> Vec<f64> {
        let mut residual = self.model.predict(p, &self.data.scene);
        for (r, reading) in residual.iter_mut().zip(&self.data.reading) {
            *r = reading - *r;
        }
        self.weigh(&mut residual);
        residual
    }

    /// Whitened residual and its Jacobian by scaled parameters (of the model: −∂r/∂x).
    pub fn linearise(&self, p: &[f64], scale: &[f64]) -> (DVector<f64>, DMatrix<f64>) {
        let n = self.data.rows();
        let tangents = self.model.differentiate(p, &self.data.scene);
        let mut columns: Vec<Vec<f64>> = (0..p.len())
            .map(|j| tangents.iter().map(|t| t.eps[j] * scale[j]).collect())
            .collect();
        let residual = tangents
            .iter()
            .zip(&self.data.reading)
            .map(|(t, y)| y - t.re);
        columns.push(residual.collect());
        columns.iter_mut().for_each(|c| self.weigh(c));
        let residual = DVector::from_vec(columns.pop().unwrap_or_default());
        (residual, DMatrix::from_fn(n, p.len(), |i, j| columns[j][i]))
    }
}

/// Minimises from `start`. Always returns the best point seen.
pub fn minimise(problem: &Problem, start: &[f64], search: Search) -> Optimum {
    let scale = problem.scale();
    let bounds = problem.model.bounds(&problem.data.scene);
    let mut p = project(start, &bounds);
    let (mut residual, mut jacobian) = problem.linearise(&p, &scale);
    let mut chi2 = residual.norm_squared();
    let mut damping = 1e-3;
    let mut iterations = 0;
    while iterations < search.iterations {
        iterations += 1;
        let gradient = jacobian.transpose() * &residual;
        let free = free_parameters(&p, &bounds, &gradient);
        let Some(step) = damped_step(&jacobian, &gradient, &free, damping) else {
            break;
        };
        let moved: Vec<f64> = p
            .iter()
            .zip(step.iter())
            .zip(&scale)
            .map(|((v, d), s)| v + d * s)
            .collect();
        let trial = project(&moved, &bounds);
        let after: f64 = problem.residual(&trial).iter().map(|r| r * r).sum();
        if after < chi2 {
            let fall = (chi2 - after) / chi2.max(f64::MIN_POSITIVE);
            p = trial;
            (residual, jacobian) = problem.linearise(&p, &scale);
            chi2 = residual.norm_squared();
            damping = (damping * 0.2).max(1e-12);
            if fall < search.tolerance {
                break;
            }
        } else {
            damping *= 6.0;
            if damping > 1e10 {
                break;
            }
        }
    }
    let active = active_bounds(&p, &bounds);
    Optimum {
        p,
        chi2,
        active,
        jacobian,
        residual,
        scale,
        iterations,
    }
}

fn project(p: &[f64], bounds: &[(f64, f64)]) -> Vec<f64> {
    p.iter()
        .zip(bounds)
        .map(|(v, (low, high))| v.clamp(*low, *high))
        .collect()
}

fn active_bounds(p: &[f64], bounds: &[(f64, f64)]) -> Vec<i8> {
    let side = |(v, (low, high)): (&f64, &(f64, f64))| {
        let near = 1e-9 * (high - low).abs();
        i8::from(*v >= high - near) - i8::from(*v <= low + near)
    };
    p.iter().zip(bounds).map(side).collect()
}

/// Parameters that may move: not on a bound with the descent pointing outwards.
fn free_parameters(p: &[f64], bounds: &[(f64, f64)], gradient: &DVector<f64>) -> Vec<usize> {
    let sides = active_bounds(p, bounds);
    (0..p.len())
        .filter(|j| f64::from(sides[*j]) * gradient[*j] <= 0.0)
        .collect()
}

fn damped_step(
    jacobian: &DMatrix<f64>,
    gradient: &DVector<f64>,
    free: &[usize],
    damping: f64,
) -> Option<DVector<f64>> {
    let columns = jacobian.select_columns(free);
    let mut normal = columns.transpose() * &columns;
    for j in 0..free.len() {
        normal[(j, j)] += damping * normal[(j, j)].max(1e-12);
    }
    let right = DVector::from_iterator(free.len(), free.iter().map(|j| gradient[*j]));
    let solved = normal.cholesky()?.solve(&right);
    let mut step = DVector::zeros(jacobian.ncols());
    for (k, j) in free.iter().enumerate() {
        step[*j] = solved[k];
    }
    Some(step)
}
