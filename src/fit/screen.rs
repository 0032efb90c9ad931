//! Noise first: project out a generous span of everything a load cycle could contain; what is left
//! is noise, and its colour decides how far every later number can be trusted.

use super::candidates::Candidates;
use crate::fit::observation::Observation;
use crate::signal::colour::Colour;
use nalgebra::{DMatrix, DVector};

/// Curves of each effect that enter the span: its whole family, coarsely.
const PER_EFFECT: usize = 4;
/// Powers of the load on each branch.
const POWERS: usize = 7;
/// Slow functions of time.
const SLOW: usize = 6;

/// Passes in which colour and residual settle.
const PASSES: usize = 3;

/// The noise of the readings: what lies outside of the span, and its colour.
pub fn screen(data: &Observation, candidates: &Candidates) -> Colour {
    let span = span(data, candidates);
    let n = span.nrows();
    let mut colour = Colour::white(n, 1.0);
    for _pass in 0..PASSES {
        let (basis, left) = project(&span, &candidates.reading, &colour);
        let share = |k: usize| (1.0 - basis.row(k).norm_squared()).max(0.0);
        let free: Vec<f64> = (0..n).map(share).collect();
        let unwhitened = left.iter().zip(&colour.sigma).map(|(r, s)| r * s);
        colour = Colour::estimate(&unwhitened.collect::<Vec<_>>(), &free);
    }
    colour
}

/// Orthonormal whitened basis of the span, and the whitened reading outside it.
fn project(span: &DMatrix<f64>, reading: &[f64], colour: &Colour) -> (DMatrix<f64>, DVector<f64>) {
    let mut weighed = span.clone();
    for (k, sigma) in colour.sigma.iter().enumerate() {
        weighed.row_mut(k).scale_mut(1.0 / sigma);
    }
    for mut column in weighed.column_iter_mut() {
        let norm = column.norm();
        if norm > 0.0 {
            column.scale_mut(1.0 / norm);
        }
    }
    let basis = orthonormal(&weighed);
    let y = DVector::from_iterator(
        reading.len(),
        reading.iter().zip(&colour.sigma).map(|(v, s)| v / s),
    );
    let inside = &basis * basis.tr_mul(&y);
    let outside = &y - &inside;
    (basis, outside)
}

/// Orthonormal basis of the columns, directions below 1e-7 of the largest left out.
pub(super) fn orthonormal(columns: &DMatrix<f64>) -> DMatrix<f64> {
    let eigen = columns.tr_mul(columns).symmetric_eigen();
    let largest = eigen.eigenvalues.iter().fold(0.0_f64, |m, v| m.max(*v));
    let kept: Vec<usize> = (0..eigen.eigenvalues.len())
        .filter(|k| eigen.eigenvalues[*k] > 1e-7 * largest)
        .collect();
    let mut mix = eigen.eigenvectors.select_columns(&kept);
    for (j, k) in kept.iter().enumerate() {
        mix.column_mut(j)
            .scale_mut(1.0 / eigen.eigenvalues[*k].sqrt());
    }
    columns * mix
}

fn span(data: &Observation, candidates: &Candidates) -> DMatrix<f64> {
    let n = data.rows();
    let mut columns: Vec<Vec<f64>> = branch_powers(data);
    for pair in columns.chunks_mut(2) {
        match pair {
            [a, b] => data.cosine.transform_pair(a, b),
            [a] => data.cosine.transform(a),
            _ => {}
        }
    }
    for k in 0..SLOW.min(n) {
        let mut slow = vec![0.0; n];
        slow[k] = 1.0;
        columns.push(slow);
    }
    for atom in representatives(candidates) {
        columns.push(candidates.atoms[atom].column.clone());
    }
    DMatrix::from_fn(n, columns.len(), |i, j| columns[j][i])
}

/// A few curves of every effect, evenly over its grid; more where the grid is long.
fn representatives(candidates: &Candidates) -> Vec<usize> {
    let mut chosen = Vec::new();
    for effect in 0..candidates.library.len() {
        let own: Vec<usize> = (0..candidates.atoms.len())
            .filter(|i| candidates.atoms[*i].effect == effect)
            .collect();
        let count = PER_EFFECT.max(own.len() / 8).min(own.len());
        chosen.extend((0..count).map(|k| own[(2 * k + 1) * own.len() / (2 * count)]));
    }
    chosen
}

/// The load over its largest, and the direction of loading.
fn loading(data: &Observation) -> [Vec<f64>; 2] {
    let scaled = data.scene.load.iter().map(|m| m / data.scene.load_scale);
    let u: Vec<f64> = scaled.map(|u| u.clamp(-1.0, 1.0)).collect();
    let direction = directions(&u);
    [u, direction]
}

/// Chebyshev polynomial of the first kind, of the scaled load.
fn chebyshev(u: &[f64], power: usize) -> Vec<f64> {
    u.iter().map(|x| (power as f64 * x.acos()).cos()).collect()
}

/// Number by number.
fn product(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a * b).collect()
}

/// Chebyshev polynomials of the load on either branch: what a law may add that no effect has, no zero among it.
pub(super) fn laws(data: &Observation) -> DMatrix<f64> {
    let [u, direction] = loading(data);
    let loops = (0..=POWERS).map(|power| product(&chebyshev(&u, power), &direction));
    let curves = (1..=POWERS).map(|power| chebyshev(&u, power));
    let columns: Vec<Vec<f64>> = loops.chain(curves).collect();
    DMatrix::from_fn(u.len(), columns.len(), |i, j| columns[j][i])
}

/// Chebyshev polynomials of the load, over all rows, times the direction of loading, and times time.
fn branch_powers(data: &Observation) -> Vec<Vec<f64>> {
    let [u, direction] = loading(data);
    let span = data.scene.duration;
    let start = data.scene.time[0];
    let mut columns = Vec::new();
    for power in 0..=POWERS {
        let polynomial = chebyshev(&u, power);
        columns.push(product(&polynomial, &direction));
        if power <= 3 {
            let aged = polynomial
                .iter()
                .zip(&data.scene.time)
                .map(|(p, t)| p * (t - start) / span);
            columns.push(aged.collect());
        }
        columns.push(polynomial);
    }
    columns
}

/// +1 while the load rises, −1 while it falls, held at rest.
pub fn directions(u: &[f64]) -> Vec<f64> {
    let mut direction = 0.0;
    let mut extreme = u.first().copied().unwrap_or(0.0);
    u.iter()
        .map(|x| {
            if (x - extreme).abs() > 0.02 {
                direction = (x - extreme).signum();
                extreme = *x;
            } else if (x - extreme) * direction > 0.0 {
                extreme = *x;
            }
            direction
        })
        .collect()
}
