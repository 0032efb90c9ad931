//! Time response: exact for a linear robot under a force that is linear between steps.

use super::dynamics::Dynamics;
use super::robot::V3;
use nalgebra::{DMatrix, DVector};

/// A spring that softens as it turns: k (1 - share) for angles far beyond `angle`.
#[derive(Clone, Copy)]
pub struct Softening {
    pub degree: usize,
    pub share: f64,
    pub angle: f64,
}

/// z+ = step z + now u + next u+, with z = (frequency times modal coordinate, its speed).
pub struct Propagator {
    step: DMatrix<f64>,
    now: DMatrix<f64>,
    next: DMatrix<f64>,
    /// Acceleration of the tool point from z and from u.
    from_state: DMatrix<f64>,
    from_input: DMatrix<f64>,
    /// Angle of the softening joint from z.
    angle: DVector<f64>,
    soft: Option<(Softening, f64)>,
}

impl Propagator {
    pub fn new(dynamics: &Dynamics, dt: f64, soft: Option<Softening>) -> Self {
        let (omega, shapes) = dynamics.modes();
        let n = omega.len();
        let degree = soft.map_or(0, |s| s.degree);
        let modal = &dynamics.jacobian * &shapes;
        let mut input = DMatrix::zeros(2 * n, 4);
        input.view_mut((n, 0), (n, 3)).copy_from(&modal.transpose());
        input
            .view_mut((n, 3), (n, 1))
            .copy_from(&shapes.row(degree).transpose());
        let mut rate = DMatrix::zeros(2 * n, 2 * n);
        for (i, w) in omega.iter().enumerate() {
            rate[(i, n + i)] = *w;
            rate[(n + i, i)] = -w;
        }
        let damped = shapes.transpose() * &dynamics.damping * &shapes;
        rate.view_mut((n, n), (n, n)).copy_from(&-damped);
        let seen = {
            let mut seen = DMatrix::zeros(3, 2 * n);
            seen.view_mut((0, n), (3, n)).copy_from(&modal);
            seen
        };
        let turned = |i: usize| {
            if i < n {
                shapes[(degree, i)] / omega[i]
            } else {
                0.0
            }
        };
        let (step, now, next) = held(&rate, &input, dt);
        Self {
            step,
            now,
            next,
            from_state: &seen * &rate,
            from_input: &seen * &input,
            angle: DVector::from_fn(2 * n, |i, _| turned(i)),
            soft: soft.map(|s| (s, dynamics.stiffness[(s.degree, s.degree)])),
        }
    }

    /// Torque that a softening spring lacks.
    fn lacking(&self, state: &DVector<f64>) -> f64 {
        self.soft.map_or(0.0, |(s, stiffness)| {
            let angle = self.angle.dot(state);
            let far = (angle / s.angle).powi(2);
            stiffness * s.share * angle * far / (1.0 + far)
        })
    }

    /// Acceleration of the tool point under a force, from rest.
    pub fn run(&self, force: &[V3]) -> Vec<V3> {
        let mut state = DVector::zeros(self.step.nrows());
        let mut last = DVector::zeros(4);
        let mut out = Vec::with_capacity(force.len());
        for f in force {
            let mut u = DVector::from_vec(vec![f.x, f.y, f.z, last[3]]);
            let base = &self.step * &state + &self.now * &last;
            state = &base + &self.next * &u;
            for _ in 0..if self.soft.is_some() { 3 } else { 0 } {
                u[3] = self.lacking(&state);
                state = &base + &self.next * &u;
            }
            let moved = &self.from_state * &state + &self.from_input * &u;
            out.push(V3::new(moved[0], moved[1], moved[2]));
            last = u;
        }
        out
    }
}

/// Exact step for an input that is linear in between (Van Loan, 1978).
fn held(
    rate: &DMatrix<f64>,
    input: &DMatrix<f64>,
    dt: f64,
) -> (DMatrix<f64>, DMatrix<f64>, DMatrix<f64>) {
    let (n, m) = (rate.nrows(), input.ncols());
    let mut all = DMatrix::zeros(n + 2 * m, n + 2 * m);
    all.view_mut((0, 0), (n, n)).copy_from(&(rate * dt));
    all.view_mut((0, n), (n, m)).copy_from(&(input * dt));
    all.view_mut((n, n + m), (m, m)).fill_with_identity();
    let grown = exponential(&all);
    let part = |column: usize, width: usize| grown.view((0, column), (n, width)).into_owned();
    let (whole, slope) = (part(n, m), part(n + m, m));
    (part(0, n), whole - &slope, slope)
}

/// Taylor series of a small fraction, squared up again.
fn exponential(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    let halvings = (matrix.norm().log2().ceil().max(0.0) + 4.0) as i32;
    let small = matrix * 0.5_f64.powi(halvings);
    let mut term = DMatrix::identity(matrix.nrows(), matrix.ncols());
    let mut sum = term.clone();
    for k in 1..=14 {
        term = &term * &small / f64::from(k);
        sum += &term;
    }
    (0..halvings).fold(sum, |s, _| &s * &s)
}
