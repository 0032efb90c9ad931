//! A linear system of masses, dampers and springs, stepped exactly.
//!
//! In modes of unit stiffness μ ẍ + D̂ ẋ + x = Ĵᵀ f; a force that is constant over a step moves the point
//! of rest, about which the state is carried by exp(A h): exact for any damping, stable for any mode.

use crate::ground::spatial::{M3, V3};
use crate::motion::modes::Modal;
use nalgebra::DMatrix;

/// Steps of one length at one pose.
#[derive(Debug, Clone)]
pub struct Oscillator {
    n: usize,
    /// exp(A h), by columns, 2n×2n: positions, then speeds.
    carry: Vec<f64>,
    /// Tool motion per mode.
    tool: Vec<V3>,
    inertia: Vec<f64>,
    damping: Vec<f64>,
    /// Change of the state per force: (1 − exp(A h)) Ĵᵀ, 2n rows.
    gain: Vec<V3>,
    /// Change of the tool per force within a step, m/N.
    pub answer: M3,
    step_s: f64,
}

impl Oscillator {
    /// Steps of `step_s`. Modes faster than the step can show are slowed to it: they follow the
    /// force either way.
    pub fn new(modal: &Modal, step_s: f64) -> Self {
        let n = modal.n;
        let least = (0.5 * step_s).powi(2);
        let inertia: Vec<f64> = modal.inertia.iter().map(|mu| mu.max(least)).collect();
        let matrix = DMatrix::from_fn(2 * n, 2 * n, |i, j| {
            let value = match (i < n, j < n) {
                (true, _) => f64::from(u8::from(j == i + n)),
                (false, true) => -f64::from(u8::from(i - n == j)) / inertia[i - n],
                (false, false) => -modal.damping[(i - n) * n + j - n] / inertia[i - n],
            };
            value * step_s
        });
        let carry = matrix.exp();
        let mut this = Self {
            n,
            carry: carry.as_slice().to_vec(),
            tool: modal.tool.clone(),
            inertia,
            damping: modal.damping.clone(),
            gain: Vec::new(),
            answer: [[0.0; 3]; 3],
            step_s,
        };
        this.prepare();
        this
    }

    fn prepare(&mut self) {
        let n = self.n;
        let row = |i: usize| {
            [0, 1, 2].map(|k| {
                let moved: f64 = (0..n)
                    .map(|j| self.carry[j * 2 * n + i] * self.tool[j][k])
                    .sum();
                if i < n {
                    self.tool[i][k] - moved
                } else {
                    -moved
                }
            })
        };
        self.gain = (0..2 * n).map(row).collect();
        for k in 0..3 {
            for l in 0..3 {
                self.answer[k][l] = (0..n).map(|i| self.tool[i][k] * self.gain[i][l]).sum();
            }
        }
    }

    /// Length of a step, s.
    pub fn step_s(&self) -> f64 {
        self.step_s
    }

    /// Carries a state over a step about the point of rest `rest` (n), without force.
    pub fn carry(&self, state: &[f64], rest: &[f64], next: &mut [f64]) {
        let (place, speed) = state.split_at(self.n);
        next[..self.n].copy_from_slice(rest);
        next[self.n..].fill(0.0);
        let off_rest = place.iter().zip(rest).map(|(x, r)| x - r);
        let columns = self.carry.chunks_exact(2 * self.n);
        for (column, share) in columns.zip(off_rest.chain(speed.iter().copied())) {
            let entries = next.iter_mut().zip(column);
            entries.for_each(|(to, from)| *to += share * from);
        }
    }

    /// Adds what a force over the step changes.
    pub fn push(&self, state: &mut [f64], force: V3) {
        for (value, gain) in state.iter_mut().zip(&self.gain) {
            *value += gain[0] * force[0] + gain[1] * force[1] + gain[2] * force[2];
        }
    }

    /// Change of the state over a step by a constant load of the modes (Φᵀ τ).
    pub fn pushed(&self, load: &[f64]) -> Vec<f64> {
        let m = 2 * self.n;
        let mut still = load.to_vec();
        still.resize(m, 0.0);
        let moved = |i: usize| -> f64 {
            let row = self.carry[i..].iter().step_by(m);
            row.zip(load).map(|(e, r)| e * r).sum()
        };
        (0..m).map(|i| still[i] - moved(i)).collect()
    }

    /// What a force on the tool over a step does to a sum of the modes with these shares.
    pub fn bent_by_force(&self, shares: &[f64]) -> V3 {
        let own = shares.iter().zip(&self.gain);
        own.fold([0.0; 3], |sum, (share, gain)| {
            [0, 1, 2].map(|k| sum[k] + share * gain[k])
        })
    }

    /// Place of the tool, m.
    pub fn tool(&self, state: &[f64]) -> V3 {
        let mut sum = [0.0; 3];
        for (v, x) in self.tool.iter().zip(state) {
            (0..3).for_each(|k| sum[k] += v[k] * x);
        }
        sum
    }

    /// Energy kept in springs and motion, J.
    pub fn stored(&self, state: &[f64]) -> f64 {
        let (place, speed) = state.split_at(self.n);
        let springs: f64 = place.iter().map(|x| x * x).sum();
        let motion: f64 = speed
            .iter()
            .zip(&self.inertia)
            .map(|(v, mu)| mu * v * v)
            .sum();
        0.5 * (springs + motion)
    }

    /// Power of the dampers, W.
    pub fn damped(&self, state: &[f64]) -> f64 {
        let speed = &state[self.n..];
        let rows = self.damping.chunks_exact(self.n);
        rows.zip(speed).map(|(row, v)| v * along(row, speed)).sum()
    }
}

/// A product of two rows, as far as the shorter one goes, summed in four parts that do not wait for one another.
pub(super) fn along(a: &[f64], b: &[f64]) -> f64 {
    let n = a.len().min(b.len());
    let (a, b) = (&a[..n], &b[..n]);
    let mut parts = [0.0; 4];
    let (fours, others) = (a.chunks_exact(4), b.chunks_exact(4));
    let rest = fours.remainder().iter().zip(others.remainder());
    let rest: f64 = rest.map(|(x, y)| x * y).sum();
    for (x, y) in fours.zip(others) {
        (0..4).for_each(|i| parts[i] += x[i] * y[i]);
    }
    parts.iter().sum::<f64>() + rest
}
