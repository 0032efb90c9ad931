//! Whether a response depends on what drives it beyond chance, whatever the colour of the noise.
//!
//! A drive that goes to and fro is cut into ramps. Over each ramp the response changes by some slope. The
//! increments of noise, of a random walk or of an unrelated oscillation over separate ramps are as
//! often of one sign as of the other relative to the drive; those of a response agree. Student's test on
//! the slopes of the ramps therefore needs no model of the noise. A second demand, that drive and time
//! together describe a good share of the response, tells what oscillates faster or slower than the drive.
//! Where the response bends, ramps of unlike range have unlike slopes: there a law that is learnt on the other ramps must
//! foretell each (`bent`). A single cycle has too few ramps for Student; there every ramp must be nearly straight, and all of one
//! slope, which a walk hardly ever is.

use super::agreement::{of_slopes, slope};
use super::bent;
use super::follows::follows;
use crate::fit::observation::reduce;
use crate::measurement::cycles::Cycles;
use crate::signal::play::play;
use nalgebra::{DMatrix, DVector};

/// How a response depends on a drive.
#[derive(Debug, Clone, PartialEq)]
pub struct Relation {
    /// Mean slope of response over drive, weighed by the squares of the drive.
    pub slope: f64,
    /// Probability that chance makes the slopes of the ramps agree so well.
    pub p_value: f64,
    /// Share of the variance beyond a slow drift that drive and its history describe.
    pub share: f64,
    /// Ramps.
    pub ramps: usize,
    /// Means of neighbouring rows of which the share is one.
    pub cells: usize,
    /// Whether the response follows the drive on every ramp, of two or more, by much the same slope.
    pub follows: bool,
}

/// Rows beyond which neighbours are averaged.
const MOST_ROWS: usize = 8000;
/// Means of neighbouring rows per ramp, for the share.
const BINS: usize = 24;
/// Chance below which a dependence counts.
const CHANCE: f64 = 1e-3;
/// Least share of the variance.
const SHARE: f64 = 0.4;
/// Ramps with which chance can be told from their slopes; of fewer from the weights that are put on, one by one.
const FEW: usize = 3;
/// Change from row to row that is a weight put on or taken off, of the whole range of the drive; and how many of them tell more
/// than halves of two ramps do.
const WEIGHT: f64 = 0.04;
const LOADINGS: usize = 5;
/// Ramps, chance and share that together tell a response of which one ramp holds something else, such as a slip: of 2000 random walks
/// over five ramps, and as many integrated once more, none had such a share.
const DESCRIBED: (usize, f64, f64) = (4, 1e-2, 0.95);
/// Means of neighbouring rows from which on that share says something: drive, history and drift have ten columns.
const CELLS: usize = 40;
/// Widths of the play operators, as shares of half the drive's range.
const PLAYS: [f64; 4] = [0.1, 0.3, 0.6, 0.9];

impl Relation {
    /// Whether the response depends on the drive.
    pub fn is_real(&self) -> bool {
        let described = self.ramps >= DESCRIBED.0
            && self.cells >= CELLS
            && self.p_value < DESCRIBED.1
            && self.share > DESCRIBED.2;
        (self.p_value < CHANCE || self.follows || described) && self.share > SHARE
    }

    /// The dependence of `response` on `drive`.
    pub fn of(drive: &[f64], response: &[f64]) -> Self {
        let turning = Cycles::find(drive).turning.len();
        let fine = (drive.len() / (turning + 1) / 40).max(1);
        let block = drive.len().div_ceil(MOST_ROWS).min(fine).max(1);
        let (drive, response) = (reduce(drive, block), reduce(response, block));
        let ramps = ramps(&drive);
        let loadings = match ramps.len() < FEW {
            true => loadings(&drive),
            false => Vec::new(),
        };
        let halves: Vec<(usize, usize)> = ramps.iter().flat_map(|r| halved(*r, &drive)).collect();
        let agreement = |pieces: &[(usize, usize)]| {
            let slopes = pieces.iter().map(|p| slope(*p, &drive, &response));
            of_slopes(&slopes.collect::<Vec<_>>())
        };
        let (slope, whole) = agreement(&ramps);
        let (_, half) = match loadings.len() < LOADINGS {
            true => agreement(&halves),
            false => agreement(&loadings),
        };
        Self {
            slope,
            p_value: 2.0
                * whole
                    .min(half)
                    .min(bent::p_value(&ramps, &drive, &response)),
            share: share(&ramps, &drive, &response),
            ramps: ramps.len(),
            cells: cells(&ramps, drive.len()).len(),
            follows: follows(&ramps, &drive, &response),
        }
    }
}

/// First and last row of every monotone piece.
pub fn ramps(drive: &[f64]) -> Vec<(usize, usize)> {
    let cycles = Cycles::find(drive);
    let ends = [drive.len().saturating_sub(1)];
    let first = [cycles.first_loaded];
    let edges: Vec<usize> = first
        .into_iter()
        .chain(cycles.turning)
        .chain(ends)
        .collect();
    let pairs = edges.windows(2).map(|w| (w[0], w[1]));
    pairs.filter(|(a, b)| b > a).collect()
}

/// Pieces of a drive that goes from level to level (dead weights), each from the last row of one level to the last of the next:
/// what a walk does in one says nothing of the next, so that each is a test of its own.
fn loadings(drive: &[f64]) -> Vec<(usize, usize)> {
    let range = super::extent(drive);
    let steps = drive.windows(2).map(|w| (w[1] - w[0]).abs());
    let way: f64 = steps.clone().sum();
    let far = |step: &f64| *step > WEIGHT * range;
    let carried: f64 = steps.clone().filter(far).sum();
    let ends = steps.enumerate().filter(|(_, step)| far(step));
    let last = drive.len().saturating_sub(1);
    let edges: Vec<usize> = ends.map(|(i, _)| i).chain([last]).collect();
    match carried > 0.5 * way {
        true => edges.windows(2).map(|w| (w[0], w[1])).collect(),
        false => Vec::new(),
    }
}

/// A ramp cut where the drive passes the middle between its ends.
pub fn halved((a, b): (usize, usize), drive: &[f64]) -> Vec<(usize, usize)> {
    let middle = 0.5 * (drive[a] + drive[b]);
    let beyond = |i: &usize| (drive[*i] > middle) == (drive[b] > middle);
    let cut = (a..b).find(beyond).unwrap_or(b);
    [(a, cut), (cut, b)]
        .into_iter()
        .filter(|(a, b)| b > a)
        .collect()
}

/// Share of the response beyond a slow drift that the drive, its cube and its play operators describe.
fn share(ramps: &[(usize, usize)], drive: &[f64], response: &[f64]) -> f64 {
    let cells = cells(ramps, drive.len());
    let half = 0.5 * super::extent(drive);
    if cells.len() < 8 || half <= 0.0 {
        return 0.0;
    }
    let middle = drive.iter().sum::<f64>() / drive.len() as f64;
    let mean = |v: &[f64]| -> Vec<f64> {
        let of = |c: &(usize, usize)| v[c.0..c.1].iter().sum::<f64>() / (c.1 - c.0) as f64;
        cells.iter().map(of).collect()
    };
    let unit: Vec<f64> = drive.iter().map(|d| (d - middle) / half).collect();
    let mut columns: Vec<Vec<f64>> = (0..4)
        .map(|k| {
            (0..cells.len())
                .map(|i| (i as f64 / cells.len() as f64 - 0.5).powi(k))
                .collect()
        })
        .collect();
    let slow = columns.len();
    columns.push(mean(&unit));
    columns.push(mean(&unit.iter().map(|u| u.powi(3)).collect::<Vec<_>>()));
    columns.extend(PLAYS.iter().map(|width| mean(&play(&unit, *width))));
    let scale = super::extent(response).max(f64::MIN_POSITIVE);
    let y: Vec<f64> = mean(response).iter().map(|v| v / scale).collect();
    let without = left(&columns[..slow], &y);
    let with = left(&columns, &y);
    if without <= 0.0 {
        0.0
    } else {
        1.0 - with / without
    }
}

/// Rows to be averaged: some per ramp.
pub fn cells(ramps: &[(usize, usize)], rows: usize) -> Vec<(usize, usize)> {
    let mut found = Vec::new();
    for (a, b) in ramps {
        let n = (b - a).clamp(1, BINS);
        let edge = |k: usize| a + k * (b - a) / n;
        found.extend((0..n).map(|k| (edge(k), edge(k + 1).min(rows))));
    }
    found.retain(|(a, b)| b > a);
    found
}

/// Sum of squares that the columns leave.
fn left(columns: &[Vec<f64>], y: &[f64]) -> f64 {
    let matrix = DMatrix::from_fn(y.len(), columns.len(), |i, j| columns[j][i]);
    let y = DVector::from_column_slice(y);
    let q = matrix.qr().q();
    (&y - &q * q.tr_mul(&y)).norm_squared()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ground::random::Random;

    fn triangle(rows: usize, period: usize) -> Vec<f64> {
        let at = |i: usize| (i as f64 / period as f64 + 0.25).fract();
        (0..rows).map(|i| 4.0 * (at(i) - 0.5).abs() - 1.0).collect()
    }

    #[test]
    fn a_noisy_spring_with_drift_depends_on_its_load() {
        let mut random = Random::new(3);
        let load = triangle(900, 300);
        let response: Vec<f64> = (0..900)
            .map(|i| load[i] + 0.001 * i as f64 + 0.3 * random.normal())
            .collect();
        let found = Relation::of(&load, &response);
        assert!(found.is_real(), "{found:?}");
        assert!((found.slope - 1.0).abs() < 0.1, "{found:?}");
    }

    #[test]
    fn a_random_walk_does_not_depend_on_it() {
        let load = triangle(900, 300);
        let walks = (0..300).filter(|seed| {
            let mut random = Random::new(*seed);
            let mut at = 0.0;
            let walk: Vec<f64> = (0..900)
                .map(|_| {
                    at += random.normal();
                    at
                })
                .collect();
            Relation::of(&load, &walk).is_real()
        });
        assert!(walks.count() <= 1);
    }

    #[test]
    fn a_slip_in_one_ramp_leaves_a_response_and_no_walk_is_one() {
        let load = triangle(400, 160);
        let slipped = |i: usize| load[i] + if i > 180 { 0.45 } else { 0.0 };
        let response: Vec<f64> = (0..400).map(slipped).collect();
        let found = Relation::of(&load, &response);
        assert!(found.is_real(), "{found:?}");
        let told = |seed: &u64| {
            let mut random = Random::new(*seed);
            let (mut at, mut speed) = (0.0, 0.0);
            let mut step = || {
                speed += random.normal();
                at += speed;
                at
            };
            let walk: Vec<f64> = (0..400).map(|_| step()).collect();
            Relation::of(&load, &walk).is_real()
        };
        assert!((0..200).filter(told).count() <= 1);
    }

    /// Up, down past zero, up again: one cycle.
    fn one_cycle(rows: usize) -> Vec<f64> {
        let at = |i: usize| std::f64::consts::TAU * i as f64 / (rows - 1) as f64;
        (0..rows).map(|i| at(i).sin()).collect()
    }

    #[test]
    fn one_cycle_of_a_loop_is_a_response_and_a_walk_is_none() {
        let load = one_cycle(240);
        let loop_of: Vec<f64> = load
            .iter()
            .zip(play(&load, 0.3))
            .map(|(f, held)| f + held)
            .collect();
        assert!(Relation::of(&load, &loop_of).is_real());
        let walks = (0..500).filter(|seed| {
            let mut random = Random::new(*seed);
            let mut at = 0.0;
            let mut step = || {
                at += random.normal();
                at
            };
            let walk: Vec<f64> = (0..240).map(|_| step()).collect();
            Relation::of(&load, &walk).is_real()
        });
        let walks = walks.count();
        assert!(walks <= 5, "{walks} of 500 walks pass");
    }
}
