//! Frequency responses of the tool: H(s) = Ĵ (s²μ + s D̂ + 1)⁻¹ Ĵᵀ, solved directly in modal
//! coordinates at any complex s, so that nothing is truncated and an exponential window is s = jω + σ.

use super::modes::{Modal, PROPORTIONAL, off_diagonal};
use nalgebra::Complex;

/// A complex number.
pub type C64 = Complex<f64>;
/// Response of the tool's three translations to forces in three directions: `[output][input]`.
pub type Response = [[C64; 3]; 3];

/// Lines solved side by side: one processor instruction serves several.
pub(super) const LANES: usize = 8;
pub(super) type Lane = [f64; LANES];

/// A complex number per lane.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lanes {
    pub(super) re: Lane,
    pub(super) im: Lane,
}

impl Lanes {
    pub(super) const ZERO: Self = Self {
        re: [0.0; LANES],
        im: [0.0; LANES],
    };

    /// At most so many numbers; the last one fills what is left.
    pub(super) fn of(lines: &[C64]) -> Self {
        let last = lines.last().copied().unwrap_or_default();
        let at = |l: usize| lines.get(l).copied().unwrap_or(last);
        Self {
            re: std::array::from_fn(|l| at(l).re),
            im: std::array::from_fn(|l| at(l).im),
        }
    }

    #[inline(always)]
    pub(super) fn minus_product(&mut self, a: &Self, b: &Self) {
        for l in 0..LANES {
            self.re[l] -= a.re[l] * b.re[l] - a.im[l] * b.im[l];
            self.im[l] -= a.re[l] * b.im[l] + a.im[l] * b.re[l];
        }
    }

    #[inline(always)]
    pub(super) fn times(&self, b: &Self) -> Self {
        let mut out = Self::ZERO;
        for l in 0..LANES {
            out.re[l] = self.re[l] * b.re[l] - self.im[l] * b.im[l];
            out.im[l] = self.re[l] * b.im[l] + self.im[l] * b.re[l];
        }
        out
    }

    #[inline(always)]
    pub(super) fn inverse(&self) -> Self {
        let mut out = Self::ZERO;
        for l in 0..LANES {
            let size = 1.0 / (self.re[l] * self.re[l] + self.im[l] * self.im[l]);
            out.re[l] = self.re[l] * size;
            out.im[l] = -self.im[l] * size;
        }
        out
    }

    #[inline(always)]
    pub(super) fn scaled(&self, k: f64) -> Self {
        Self {
            re: self.re.map(|x| x * k),
            im: self.im.map(|x| x * k),
        }
    }
}

/// Reusable space for [`accelerance`].
#[derive(Debug, Clone, Default)]
pub struct FrfWork {
    matrix: Vec<Lanes>,
    inverse: Vec<Lanes>,
    row: Vec<Lanes>,
    rhs: [Vec<Lanes>; 3],
}

impl FrfWork {
    fn resize(&mut self, n: usize) {
        self.matrix.resize(n * n, Lanes::ZERO);
        self.inverse.resize(n, Lanes::ZERO);
        self.row.resize(n, Lanes::ZERO);
        self.rhs
            .iter_mut()
            .for_each(|rhs| rhs.resize(n, Lanes::ZERO));
    }
}

/// Accelerance s²H(s) of the tool, (m/s²)/N, base axes, at every `s` (1/s): jω on the frequency axis.
pub fn accelerance(modal: &Modal, work: &mut FrfWork, s: &[C64]) -> Vec<Response> {
    let mut out = response(modal, work, s);
    for (response, s) in out.iter_mut().zip(s) {
        let square = s * s;
        response
            .iter_mut()
            .flatten()
            .for_each(|entry| *entry *= square);
    }
    out
}

/// Dynamic compliance H(s) of the tool, m/N, base axes, at every `s` (1/s).
pub fn response(modal: &Modal, work: &mut FrfWork, s: &[C64]) -> Vec<Response> {
    work.resize(modal.n);
    let proportional = off_diagonal(modal) < PROPORTIONAL;
    let mut out = Vec::with_capacity(s.len());
    for lines in s.chunks(LANES) {
        let s = Lanes::of(lines);
        if proportional {
            uncoupled(modal, work, &s);
        } else {
            factor(modal, work, &s);
        }
        collect(modal, work, lines.len(), &mut out);
    }
    out
}

/// Proportional damping: the modes do not couple, s²μ + s D̂ + 1 is diagonal and L = 1.
fn uncoupled(modal: &Modal, work: &mut FrfWork, s: &Lanes) {
    let square = s.times(s);
    for i in 0..modal.n {
        work.inverse[i] = pivot(modal, i, s, &square).inverse();
        for axis in 0..3 {
            work.rhs[axis][i] = real(modal.tool[i][axis]);
        }
    }
}

#[inline(always)]
fn pivot(modal: &Modal, i: usize, s: &Lanes, square: &Lanes) -> Lanes {
    let d = modal.damping[i * modal.n + i];
    let mut out = square.scaled(modal.inertia[i]);
    for l in 0..LANES {
        out.re[l] += d * s.re[l] + 1.0;
        out.im[l] += d * s.im[l];
    }
    out
}

#[inline(always)]
pub(super) fn real(x: f64) -> Lanes {
    Lanes {
        re: [x; LANES],
        im: [0.0; LANES],
    }
}

/// L D Lᵀ of the complex symmetric matrix, with L⁻¹Ĵᵀ row by row.
fn factor(modal: &Modal, work: &mut FrfWork, s: &Lanes) {
    let n = modal.n;
    let square = s.times(s);
    for i in 0..n {
        let (done, rest) = work.matrix.split_at_mut(i * n);
        let mut last = pivot(modal, i, s, &square);
        for j in 0..i {
            let mut value = s.scaled(modal.damping[i * n + j]);
            let known = &done[j * n..j * n + j];
            for (v, l) in work.row.iter().zip(known) {
                value.minus_product(v, l);
            }
            work.row[j] = value;
            rest[j] = value.times(&work.inverse[j]);
            last.minus_product(&value, &rest[j]);
        }
        work.inverse[i] = last.inverse();
        for axis in 0..3 {
            let mut value = real(modal.tool[i][axis]);
            for (l, y) in rest[..i].iter().zip(&work.rhs[axis]) {
                value.minus_product(l, y);
            }
            work.rhs[axis][i] = value;
        }
    }
}

/// Ĵ (L D Lᵀ)⁻¹ Ĵᵀ = (L⁻¹Ĵᵀ)ᵀ D⁻¹ (L⁻¹Ĵᵀ), symmetric.
fn collect(modal: &Modal, work: &FrfWork, lines: usize, out: &mut Vec<Response>) {
    let mut sums = [[Lanes::ZERO; 3]; 3];
    for i in 0..modal.n {
        for (a, row) in sums.iter_mut().enumerate() {
            let left = work.rhs[a][i].times(&work.inverse[i]).scaled(-1.0);
            for (sum, right) in row.iter_mut().zip(&work.rhs).take(a + 1) {
                sum.minus_product(&left, &right[i]);
            }
        }
    }
    let entry = |a: usize, b: usize, l: usize| {
        let sum = &sums[a.max(b)][a.min(b)];
        C64::new(sum.re[l], sum.im[l])
    };
    out.extend(
        (0..lines).map(|l| std::array::from_fn(|a| std::array::from_fn(|b| entry(a, b, l)))),
    );
}

/// The lines 0 < f ≤ `to` in steps of `step` (Hz).
pub fn lines(to: f64, step: f64) -> Vec<f64> {
    let count = (to / step + 1e-9).floor() as usize;
    (1..=count).map(|k| k as f64 * step).collect()
}
