//! Stability of milling: the delay equation of regenerative chatter, collocated at Chebyshev nodes.
//!
//! x(t) answers to F = w A(t) (x(t) - x(t - τ)), A from the teeth in cut. Over one tooth passing the
//! force is a polynomial at Chebyshev nodes of each stretch in which A is smooth; modes are carried over
//! such a stretch by collocation of their own equation, over idle stretches exactly. Spectral accuracy
//! needs about 4.5 nodes per oscillation of the fastest mode and, for the teeth, a dozen more (Butcher and others 2009; Bobrenkov and others 2010).

use super::carried::{Carried, carried, places};
use super::chebyshev::Stretch;
use super::directional::Directional;
use super::krylov;
use crate::ground::spatial::V3;
use nalgebra::{Complex, DMatrix, DVector, Dyn, LU};
use std::f64::consts::TAU;

/// One mode of the tool tip against the workpiece.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TipMode {
    /// Unit vector along which the tip moves, cut frame; its length scales the mode.
    pub direction: V3,
    /// Undamped circular frequency, rad/s; infinite: a spring without mass.
    pub omega: f64,
    /// Damping ratio.
    pub damping_ratio: f64,
    /// Modal stiffness, N/m.
    pub stiffness: f64,
}

/// A mode that swings more often than this within a tooth passing answers as a spring.
const QUASI_STATIC: f64 = 60.0;

/// A cut at one spindle speed, ready for any depth that keeps its teeth where they are.
#[derive(Debug, Clone)]
pub struct Passing {
    /// Displacements at the nodes per state at the start.
    start: DMatrix<f64>,
    /// Displacements at the nodes per depth and displacement difference at the nodes.
    nodes: DMatrix<f64>,
    /// State at the end per state at the start.
    carry: DMatrix<f64>,
    /// State at the end per depth and difference at the nodes.
    kick: DMatrix<f64>,
    period_s: f64,
    omegas: Vec<f64>,
}

/// The largest multiplier of a tooth passing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Multiplier {
    /// Its size: below 1 chatter dies out.
    pub radius: f64,
    /// Frequency at which the strongest mode swings with it, Hz.
    pub frequency_hz: f64,
}

/// Imaginary part, of its size, below which a multiplier is real.
const REAL: f64 = 1e-9;

/// No answer.
const UNSTABLE: Multiplier = Multiplier {
    radius: f64::INFINITY,
    frequency_hz: 0.0,
};

/// What one tooth passing does at one depth.
struct Map<'a> {
    passing: &'a Passing,
    depth_m: f64,
    own: DMatrix<f64>,
    solved: LU<f64, Dyn, Dyn>,
}

impl Map<'_> {
    /// Displacements at the nodes and the state at the end, from those of the passing before.
    fn after(&self, before: &DVector<f64>) -> DVector<f64> {
        let n = self.own.nrows();
        let (nodes, state) = (before.rows(0, n), before.rows(n, before.len() - n));
        let mut now = &self.passing.start * state - &self.own * nodes;
        self.solved.solve_mut(&mut now);
        let kick = &self.passing.kick * ((&now - nodes) * self.depth_m);
        let end = &self.passing.carry * state + kick;
        let mut after = DVector::zeros(before.len());
        after.rows_mut(0, n).copy_from(&now);
        after.rows_mut(n, end.len()).copy_from(&end);
        after
    }
}

impl Passing {
    /// Prepares the cut of one tooth passing. `refine` multiplies the number of nodes.
    pub fn new(modes: &[TipMode], cut: &Directional, passing_s: f64, refine: f64) -> Self {
        let (swinging, springs): (Vec<TipMode>, Vec<TipMode>) = modes
            .iter()
            .partition(|m| m.omega * passing_s / TAU < QUASI_STATIC);
        let fastest = swinging.iter().map(|m| m.omega).fold(0.0, f64::max);
        let stretches = cut.stretches(passing_s);
        let grid: Vec<(Stretch, Vec<f64>)> = stretches
            .iter()
            .map(|s| (*s, places(s, fastest, refine)))
            .collect();
        let total: usize = grid.iter().map(|g| g.1.len()).sum();
        let axes: Vec<usize> = (0..2)
            .filter(|k| modes.iter().any(|m| m.direction[*k] != 0.0))
            .collect();
        let force = Self::forces(cut, &grid, passing_s, &axes);
        let mut passing = Self {
            start: DMatrix::zeros(axes.len() * total, 2 * swinging.len()),
            nodes: DMatrix::zeros(axes.len() * total, axes.len() * total),
            carry: DMatrix::zeros(2 * swinging.len(), 2 * swinging.len()),
            kick: DMatrix::zeros(2 * swinging.len(), axes.len() * total),
            period_s: passing_s,
            omegas: swinging.iter().map(|m| m.omega).collect(),
        };
        for (i, mode) in swinging.iter().enumerate() {
            passing.add(i, mode, &carried(mode, &grid, total), &force, &axes);
        }
        for mode in &springs {
            passing.add_spring(mode, &force, &axes);
        }
        passing
    }

    /// Force per difference of displacement at every node: rows node·3, columns node·axes.
    fn forces(
        cut: &Directional,
        grid: &[(Stretch, Vec<f64>)],
        passing_s: f64,
        axes: &[usize],
    ) -> Vec<Vec<V3>> {
        let pitch = cut.pitch_rad();
        let at = |(stretch, times): &(Stretch, Vec<f64>)| -> Vec<Vec<V3>> {
            let of = |t: &f64| {
                let matrix = cut.at(t / passing_s * pitch, stretch.middle_s / passing_s * pitch);
                axes.iter().map(|k| matrix[*k]).collect()
            };
            times.iter().map(of).collect()
        };
        grid.iter().flat_map(at).collect()
    }

    fn add(
        &mut self,
        i: usize,
        mode: &TipMode,
        carried: &Carried,
        force: &[Vec<V3>],
        axes: &[usize],
    ) {
        let d = axes.len();
        for (row, k) in (0..force.len()).flat_map(|n| (0..d).map(move |k| (n, k))) {
            let along = mode.direction[axes[k]];
            for s in 0..2 {
                self.start[(row * d + k, 2 * i + s)] = along * carried.answers[(row, s)];
            }
            for (node, columns) in force.iter().enumerate() {
                let answer = along * carried.answers[(row, 2 + node)];
                for (c, column) in columns.iter().enumerate() {
                    self.nodes[(row * d + k, node * d + c)] += answer * drive(mode, column);
                }
            }
        }
        for s in 0..2 {
            for q in 0..2 {
                self.carry[(2 * i + s, 2 * i + q)] = carried.state[(s, q)];
            }
            for (node, columns) in force.iter().enumerate() {
                for (c, column) in columns.iter().enumerate() {
                    self.kick[(2 * i + s, node * d + c)] =
                        carried.state[(s, 2 + node)] * drive(mode, column);
                }
            }
        }
    }

    fn add_spring(&mut self, mode: &TipMode, force: &[Vec<V3>], axes: &[usize]) {
        let d = axes.len();
        for (node, columns) in force.iter().enumerate() {
            for (k, axis) in axes.iter().enumerate() {
                let answer = mode.direction[*axis] / mode.stiffness;
                for (c, column) in columns.iter().enumerate() {
                    self.nodes[(node * d + k, node * d + c)] += answer * drive(mode, column);
                }
            }
        }
    }

    /// The map from one tooth passing to the next at a depth of cut, m; `None`: the cut has no answer there.
    fn map(&self, depth_m: f64) -> Option<Map<'_>> {
        let n = self.nodes.nrows();
        let own = &self.nodes * depth_m;
        let solved = (DMatrix::identity(n, n) - &own).lu();
        let possible = own.iter().all(|v| v.is_finite()) && solved.is_invertible();
        possible.then_some(Map {
            passing: self,
            depth_m,
            own,
            solved,
        })
    }

    /// Size of the multiplier that decides at a depth of cut, m. A map that cannot be made counts as unstable.
    pub fn radius(&self, depth_m: f64) -> f64 {
        let map = self.map(depth_m);
        let value = map.and_then(|map| krylov::largest(self.size(), |before| map.after(before)));
        value.map_or(UNSTABLE.radius, Complex::norm)
    }

    /// The same with the frequency at which it swings.
    pub fn multiplier(&self, depth_m: f64) -> Multiplier {
        let map = self.map(depth_m);
        let found = map.and_then(|map| krylov::pair(self.size(), |before| map.after(before)));
        found.map_or(UNSTABLE, |(value, vector)| Multiplier {
            radius: value.norm(),
            frequency_hz: self.frequency(value, &vector.as_slice()[self.nodes.nrows()..]),
        })
    }

    /// Displacements at the nodes, and states.
    fn size(&self) -> usize {
        self.nodes.nrows() + self.carry.nrows()
    }

    /// Of all frequencies |arg/2πτ + k/τ| the one at which the strongest mode swings: how fast it goes where it stands says which. A real
    /// multiplier (0, or half a turn per passing) has no such phase: there the one nearest to that mode.
    fn frequency(&self, value: Complex<f64>, states: &[Complex<f64>]) -> f64 {
        let base = value.arg() / (TAU * self.period_s);
        let size = |i: &usize| states[2 * i].norm_sqr() + states[2 * i + 1].norm_sqr();
        let modes = 0..self.omegas.len();
        let Some(strongest) = modes.max_by(|a, b| size(a).total_cmp(&size(b))) else {
            return base;
        };
        let (place, speed) = (states[2 * strongest], states[2 * strongest + 1]);
        let turns = (place.conj() * speed).im / place.norm_sqr();
        let natural = self.omegas[strongest] / TAU;
        let swings = match value.im.abs() > REAL * value.norm() && turns.is_finite() {
            true => natural * turns,
            false => natural,
        };
        let passings = ((swings - base) * self.period_s).round();
        (base + passings / self.period_s).abs()
    }
}

/// What a force column does to a mode: its part along it.
fn drive(mode: &TipMode, column: &V3) -> f64 {
    (0..3).map(|k| mode.direction[k] * column[k]).sum()
}

/// The first depth, m, from `least` up to `most`, at which chatter no longer dies out; `None`: not up to there. Zero where it does not even
/// at `least`: how much less is not looked for.
pub fn limit(radius: impl Fn(f64) -> f64, least: f64, most: f64) -> Option<f64> {
    let steps = ((most / least).ln() / STEP.ln()).ceil().max(1.0) as usize;
    let at = |i: usize| least * (most / least).powf(i as f64 / steps as f64);
    let first = (0..=steps).find(|i| radius(at(*i)) >= 1.0)?;
    if first == 0 {
        return Some(0.0);
    }
    let (mut low, mut high) = (at(first - 1), at(first));
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (low + high);
        match radius(middle) >= 1.0 {
            true => high = middle,
            false => low = middle,
        }
    }
    Some(0.5 * (low + high))
}

/// Factor from depth to depth of the search.
const STEP: f64 = 1.25;
/// Halvings of the interval found: 0.1 % of the depth.
const BISECTIONS: usize = 8;
