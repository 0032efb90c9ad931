//! Every elastic coordinate's answer to forces at the tool: Y(s) = (s²M + sD + K)⁻¹ Jᵀ. With it the
//! change of any mass, damper or spring is a product: ∂H = −Yᵀ(s²∂M + s∂D + ∂K)Y.

use super::frf::{C64, LANES, Lanes, real};
use super::linear::Linear;
use crate::ground::spatial::V3;

/// Per line the answers of all coordinates, `[line * n + coordinate][direction of the force]`, rad/N.
pub fn coordinates(linear: &Linear, s: &[C64]) -> Vec<[C64; 3]> {
    let mut space = Space::new(linear.n);
    let mut out = Vec::with_capacity(s.len() * linear.n);
    for lines in s.chunks(LANES) {
        let s = Lanes::of(lines);
        space.factor(linear, &s);
        space.forward(linear);
        space.backward();
        for l in 0..lines.len() {
            let entry = |i: usize| [0, 1, 2].map(|k| space.y[k][i].at(l));
            out.extend((0..linear.n).map(entry));
        }
    }
    out
}

/// Accelerance of the tool from [`coordinates`] of one line: s² J Y, output by input.
pub fn accelerance(linear: &Linear, answers: &[[C64; 3]], s: C64) -> [[C64; 3]; 3] {
    moved(&linear.tool, answers, s)
}

/// Acceleration of the tool under a moment on it, from [`coordinates`] of one line: s² Yᵀ Jᵣᵀ, output by axis of
/// the moment, (m/s²)/(N·m). By reciprocity: what a force turns, a moment moves.
pub fn under_moments(linear: &Linear, answers: &[[C64; 3]], s: C64) -> [[C64; 3]; 3] {
    let turned = moved(&linear.turn, answers, s);
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| turned[j][i]))
}

/// s² Σ lever ⊗ answer over all coordinates.
fn moved(levers: &[V3], answers: &[[C64; 3]], s: C64) -> [[C64; 3]; 3] {
    let mut sum = [[C64::default(); 3]; 3];
    for (column, answer) in levers.iter().zip(answers) {
        for (row, lever) in sum.iter_mut().zip(column) {
            for (entry, y) in row.iter_mut().zip(answer) {
                *entry += y * *lever;
            }
        }
    }
    sum.map(|row| row.map(|entry| entry * s * s))
}

impl Lanes {
    fn at(&self, l: usize) -> C64 {
        C64::new(self.re[l], self.im[l])
    }
}

/// L, D⁻¹ and three right-hand sides.
struct Space {
    n: usize,
    lower: Vec<Lanes>,
    inverse: Vec<Lanes>,
    row: Vec<Lanes>,
    y: [Vec<Lanes>; 3],
}

impl Space {
    fn new(n: usize) -> Self {
        let zeros = || vec![Lanes::ZERO; n];
        Self {
            n,
            lower: vec![Lanes::ZERO; n * n],
            inverse: zeros(),
            row: zeros(),
            y: [zeros(), zeros(), zeros()],
        }
    }

    /// L D Lᵀ = s²M + sD + K, complex symmetric.
    fn factor(&mut self, linear: &Linear, s: &Lanes) {
        let n = self.n;
        let square = s.times(s);
        for i in 0..n {
            let (done, rest) = self.lower.split_at_mut(i * n);
            for j in 0..=i {
                let mut value = dynamic(linear, i * n + j, s, &square);
                let known = if j < i {
                    &done[j * n..j * n + j]
                } else {
                    &rest[..i]
                };
                for (v, l) in self.row.iter().zip(known) {
                    value.minus_product(v, l);
                }
                if j < i {
                    self.row[j] = value;
                    rest[j] = value.times(&self.inverse[j]);
                } else {
                    self.inverse[i] = value.inverse();
                }
            }
        }
    }

    fn forward(&mut self, linear: &Linear) {
        for (axis, y) in self.y.iter_mut().enumerate() {
            for i in 0..self.n {
                let mut value = real(linear.tool[i][axis]);
                for (l, known) in self.lower[i * self.n..i * self.n + i].iter().zip(&*y) {
                    value.minus_product(l, known);
                }
                y[i] = value;
            }
        }
    }

    fn backward(&mut self) {
        for y in &mut self.y {
            for i in (0..self.n).rev() {
                let mut value = y[i].times(&self.inverse[i]);
                for (j, known) in y.iter().enumerate().skip(i + 1) {
                    value.minus_product(&self.lower[j * self.n + i], known);
                }
                y[i] = value;
            }
        }
    }
}

#[inline(always)]
fn dynamic(linear: &Linear, at: usize, s: &Lanes, square: &Lanes) -> Lanes {
    let (m, d, k) = (linear.mass[at], linear.damping[at], linear.stiffness[at]);
    let mut out = square.scaled(m);
    for l in 0..LANES {
        out.re[l] += d * s.re[l] + k;
        out.im[l] += d * s.im[l];
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::frf::{FrfWork, accelerance as modal_accelerance};
    use crate::motion::modes::modal;
    use crate::motion::{Work, elastic, linearise};
    use crate::robot::builtin;

    #[test]
    fn agrees_with_the_modal_way() {
        let robot = crate::robot::load::load(builtin::BUILTINS[0].0, None)
            .unwrap()
            .robot;
        let chain = elastic(&robot);
        let q = chain.spread(&[0.3, -1.2, 1.7, 0.5, 0.8, 0.2]);
        let linear = linearise(&chain, &mut Work::new(&chain), &q).unwrap();
        let s: Vec<C64> = (1..20)
            .map(|f| C64::new(1.3, 15.0 * f64::from(f)))
            .collect();
        let wanted = modal_accelerance(&modal(&linear).unwrap(), &mut FrfWork::default(), &s);
        let answers = coordinates(&linear, &s);
        for (k, s) in s.iter().enumerate() {
            let found = accelerance(&linear, &answers[k * linear.n..(k + 1) * linear.n], *s);
            for (a, b) in found.iter().flatten().zip(wanted[k].iter().flatten()) {
                assert!((a - b).norm() < 1e-8 * wanted[k][0][0].norm(), "{a} {b}");
            }
        }
    }
}
