//! Whitened normal equations of a dictionary of curves, the spring projected out.

use super::candidates::Candidates;
use crate::ground::products;
use crate::signal::colour::Colour;
use nalgebra::DMatrix;

/// A set of curves and how much of the misfit it explains.
#[derive(Debug, Clone)]
pub struct Found {
    /// Atoms.
    pub atoms: Vec<usize>,
    /// Their amplitudes, SI.
    pub amplitudes: Vec<f64>,
    /// Half the fall of the whitened sum of squares below the spring alone (nats, not tempered).
    pub nats: f64,
}

/// The whitened normal equations of all curves with the spring projected out.
pub struct Normal {
    gram: DMatrix<f64>,
    right: Vec<f64>,
    /// Whitened sum of squares that the spring alone leaves.
    pub base: f64,
    usable: Vec<bool>,
}

/// Curves that the spring imitates to better than this share are useless here.
const COLLINEAR: f64 = 1e-7;

impl Normal {
    /// Builds them.
    pub fn new(candidates: &Candidates, colour: &Colour) -> Self {
        let n = candidates.reading.len();
        let m = candidates.atoms.len();
        let column = |j: usize| match j {
            0 => &candidates.spring,
            _ => &candidates.atoms[j - 1].column,
        };
        let whitened = DMatrix::from_fn(n, m + 1, |i, j| column(j)[i] / colour.sigma[i]);
        let y: Vec<f64> = candidates
            .reading
            .iter()
            .zip(&colour.sigma)
            .map(|(v, s)| v / s)
            .collect();
        let y = nalgebra::DVector::from_vec(y);
        let full = products::gram(&whitened);
        let product = whitened.tr_mul(&y);
        let spring = full[(0, 0)].max(f64::MIN_POSITIVE);
        let gram = DMatrix::from_fn(m, m, |i, j| {
            full[(i + 1, j + 1)] - full[(i + 1, 0)] * full[(0, j + 1)] / spring
        });
        let right = (0..m)
            .map(|i| product[i + 1] - full[(i + 1, 0)] * product[0] / spring)
            .collect();
        let base = y.norm_squared() - product[0] * product[0] / spring;
        let usable = (0..m)
            .map(|i| gram[(i, i)] > COLLINEAR * full[(i + 1, i + 1)])
            .collect();
        Self {
            gram,
            right,
            base,
            usable,
        }
    }

    /// One atom alone.
    pub fn single(&self, i: usize) -> Option<Found> {
        if !self.usable[i] {
            return None;
        }
        let amplitude = self.right[i] / self.gram[(i, i)];
        Some(Found {
            atoms: vec![i],
            amplitudes: vec![amplitude],
            nats: 0.5 * amplitude * self.right[i],
        })
    }

    /// Least squares over up to three atoms; `None` when they are collinear.
    pub fn solve(&self, atoms: &[usize]) -> Option<Found> {
        if atoms.iter().any(|i| !self.usable[*i]) {
            return None;
        }
        let k = atoms.len();
        let mut a = [[0.0; 4]; 3];
        for (r, i) in atoms.iter().enumerate() {
            for (c, j) in atoms.iter().enumerate() {
                a[r][c] = self.gram[(*i, *j)];
            }
            a[r][3] = self.right[*i];
        }
        let amplitudes = eliminate(&mut a, k)?;
        let nats = amplitudes
            .iter()
            .zip(atoms)
            .map(|(x, i)| 0.5 * x * self.right[*i])
            .sum();
        Some(Found {
            atoms: atoms.to_vec(),
            amplitudes,
            nats,
        })
    }
}

/// Gaussian elimination of a positive definite system of size k ≤ 3.
fn eliminate(a: &mut [[f64; 4]; 3], k: usize) -> Option<Vec<f64>> {
    for pivot in 0..k {
        let size = a[pivot][pivot];
        for row in pivot + 1..k {
            let factor = a[row][pivot] / size;
            let upper = a[pivot];
            let before = a[row][row];
            for (value, above) in a[row].iter_mut().zip(upper) {
                *value -= factor * above;
            }
            if a[row][row] < 1e-6 * before {
                return None;
            }
        }
    }
    let mut x = vec![0.0; k];
    for row in (0..k).rev() {
        let known: f64 = (row + 1..k).map(|c| a[row][c] * x[c]).sum();
        x[row] = (a[row][3] - known) / a[row][row];
    }
    Some(x)
}
