//! Instants at which a reading changes its level whatever the load does. On a grid of places they would be missed by a few
//! rows, and what is wrong in these is as large as the jump: enough to bring in a second cause.

use crate::fit::screen::directions;
use crate::ground::products::gram;
use crate::signal::steps::{sharpest, steps};
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
}

/// Where a reading jumps; `u`, `t`: load and time, of their largest.
pub fn jumps(u: &[f64], t: &[f64], reading: &[f64]) -> Jumps {
    let steps = steps(&left(u, t, reading));
    let rows = sharpest(&steps, SHARPEST);
    let twice = match rows[..] {
        [a, b, c, ..] if steps[b].abs() > STANDS_OUT * steps[c].abs() => Some([a, b]),
        _ => None,
    };
    Jumps { rows, twice }
}

/// What the spring, curves of the load and a straight course of time leave of a reading.
fn left(u: &[f64], t: &[f64], reading: &[f64]) -> Vec<f64> {
    let up: Vec<bool> = directions(u).iter().map(|d| *d > 0.0).collect();
    let wave = |k: usize, on: bool| {
        let place = |i: usize| 0.5 * (1.0 + u[i].clamp(-1.0, 1.0));
        let at = |i: usize| f64::from(u8::from(up[i] == on)) * (PI * k as f64 * place(i)).cos();
        DVector::from_iterator(u.len(), (0..u.len()).map(at))
    };
    let each = (0..=WAVES).flat_map(|k| [wave(k, true), wave(k, false)]);
    let straight = [u, t].map(DVector::from_column_slice);
    let columns: Vec<DVector<f64>> = each.chain(straight).collect();
    let matrix = DMatrix::from_columns(&columns);
    let y = DVector::from_column_slice(reading);
    let mut inner = gram(&matrix);
    (0..columns.len()).for_each(|i| inner[(i, i)] += 1e-9 * u.len() as f64);
    match inner.cholesky() {
        Some(root) => (&y - &matrix * root.solve(&matrix.tr_mul(&y)))
            .as_slice()
            .to_vec(),
        None => reading.to_vec(),
    }
}
