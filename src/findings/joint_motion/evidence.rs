//! Sets of causes by evidence: every single and pair, and the larger sets that continue the best.

use super::channels::Channels;
use super::columns::{Atom, Kind, base};
use super::noise::{Noise, orthonormal, without};
use nalgebra::{DMatrix, DVector};
use std::collections::BTreeMap;

/// Prior probability that any one cause is present.
const PRIOR: f64 = 0.08;
/// A law that misses the truth by this share of its own size still counts as right: nature does not
/// follow our formulas exactly (coarsened likelihood, Miller and Dunson 2019).
const FORMULA_ERROR: f64 = 0.07;
/// Nats that such a misfit is worth at most.
const TOLERATED_NATS: f64 = 5.0;

/// How much of the evidence counts when the whole misfit is worth `nats`.
fn temper(nats: f64) -> f64 {
    1.0 / (1.0 + FORMULA_ERROR * FORMULA_ERROR * nats.max(0.0) / TOLERATED_NATS)
}

/// Normal equations of all candidates, after the base is projected out.
pub struct Evidence {
    gram: DMatrix<f64>,
    right: DVector<f64>,
    /// First column of each atom.
    starts: Vec<usize>,
    /// Half the whitened sum of squares that the base leaves, and that the span leaves.
    pub ceiling: f64,
    /// Whitened sum of squares that the base leaves.
    pub base: f64,
    ones: Vec<f64>,
    rows: usize,
}

/// A set of atoms with its score.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Set {
    /// Indices of its atoms.
    pub atoms: Vec<usize>,
    /// Half the fall of the whitened sum of squares.
    pub nats: f64,
    /// Log evidence.
    pub score: f64,
}

/// Most atoms of a set.
const LARGEST: usize = 4;
/// Sets of each size that are continued.
const CONTINUED: usize = 20;

impl Evidence {
    /// Of a joint.
    pub fn new(data: &Channels, atoms: &[Atom], noise: &Noise) -> Self {
        let basis = orthonormal(base(data).iter().map(|c| noise.whiten(c)).collect());
        let free = |column: &[f64]| without(&basis, noise.whiten(column));
        let mut columns = Vec::new();
        let mut starts = Vec::new();
        for atom in atoms {
            starts.push(columns.len());
            columns.extend(atom.columns.iter().map(|c| free(c)));
        }
        starts.push(columns.len());
        let matrix = DMatrix::from_columns(&columns);
        let reading = free(&data.twist);
        let base = reading.norm_squared();
        Self {
            gram: matrix.tr_mul(&matrix),
            right: matrix.tr_mul(&reading),
            starts,
            ceiling: 0.5 * (base - noise.saturated).max(0.0),
            base,
            ones: vec![1.0; data.rows()],
            rows: data.rows(),
        }
    }

    /// The column of the zero.
    pub fn ones(&self) -> &[f64] {
        &self.ones
    }

    /// The set of these atoms; `None` where an amplitude has the wrong sign or columns coincide.
    pub fn set(&self, indices: &[usize], atoms: &[Atom]) -> Option<Set> {
        let columns: Vec<usize> = indices
            .iter()
            .flat_map(|i| self.starts[*i]..self.starts[i + 1])
            .collect();
        let (amplitudes, nats) = self.solve(&columns)?;
        let mut at = 0;
        for i in indices {
            if atoms[*i].one_signed && amplitudes[at] <= 0.0 {
                return None;
            }
            at += atoms[*i].columns.len();
        }
        let price = 0.5 * columns.len() as f64 * (self.rows as f64).ln();
        let shapes: f64 = indices.iter().map(|i| (atoms[*i].tried as f64).ln()).sum();
        let odds = (PRIOR / (1.0 - PRIOR)).ln() * indices.len() as f64;
        Some(Set {
            atoms: indices.to_vec(),
            nats,
            score: temper(self.ceiling) * nats - price - shapes + odds,
        })
    }

    fn solve(&self, columns: &[usize]) -> Option<(DVector<f64>, f64)> {
        let n = columns.len();
        let scale: Vec<f64> = columns.iter().map(|j| self.gram[(*j, *j)].sqrt()).collect();
        if scale.iter().any(|s| *s <= 1e-9) {
            return None;
        }
        let entry = |i: usize, j: usize| {
            let (a, b) = (columns[i], columns[j]);
            self.gram[(a, b)] / (scale[i] * scale[j]) + if i == j { 1e-9 } else { 0.0 }
        };
        let right = DVector::from_fn(n, |i, _| self.right[columns[i]] / scale[i]);
        let solved = DMatrix::from_fn(n, n, entry).cholesky()?.solve(&right);
        let nats = 0.5 * solved.dot(&right);
        let amplitudes = DVector::from_fn(n, |i, _| solved[i] / scale[i]);
        Some((amplitudes, nats))
    }

    /// The best set of every combination of kinds, best first; the empty one is among them.
    pub fn search(&self, atoms: &[Atom]) -> Vec<(Vec<Kind>, Set)> {
        let m = atoms.len();
        let mut best = Best::default();
        best.sets.insert(Vec::new(), Set::default());
        for i in 0..m {
            best.offer(self, atoms, vec![i]);
            (i + 1..m).for_each(|j| best.offer(self, atoms, vec![i, j]));
        }
        for size in 2..LARGEST {
            for set in best.top(size) {
                for j in 0..m {
                    let mut more = set.clone();
                    more.push(j);
                    best.offer(self, atoms, more);
                }
            }
        }
        let mut all: Vec<_> = best.sets.into_iter().collect();
        all.sort_by(|a, b| b.1.score.total_cmp(&a.1.score));
        all
    }
}

/// The best set of each combination of kinds.
#[derive(Default)]
struct Best {
    sets: BTreeMap<Vec<Kind>, Set>,
}

impl Best {
    fn offer(&mut self, evidence: &Evidence, atoms: &[Atom], indices: Vec<usize>) {
        let kinds = kinds(&indices, atoms);
        if kinds.windows(2).any(|w| w[0] == w[1]) {
            return;
        }
        let Some(set) = evidence.set(&indices, atoms) else {
            return;
        };
        let better = |old: &Set| old.score >= set.score;
        if !self.sets.get(&kinds).is_some_and(better) {
            self.sets.insert(kinds, set);
        }
    }

    fn top(&self, size: usize) -> Vec<Vec<usize>> {
        let of_size = |s: &&Set| s.atoms.len() == size;
        let mut sets: Vec<&Set> = self.sets.values().filter(of_size).collect();
        sets.sort_by(|a, b| b.score.total_cmp(&a.score));
        sets.iter()
            .take(CONTINUED)
            .map(|s| s.atoms.clone())
            .collect()
    }
}

/// Kinds of atoms, sorted.
pub fn kinds(indices: &[usize], atoms: &[Atom]) -> Vec<Kind> {
    let mut kinds: Vec<Kind> = indices.iter().map(|i| atoms[*i].kind).collect();
    kinds.sort_unstable();
    kinds
}
