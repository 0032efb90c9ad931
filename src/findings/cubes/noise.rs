//! Noise of cubes where the file states none: what they do that is in no proportion to the loads.

use super::Row;
use crate::ground::stats::mean;
use crate::measurement::cubes::CubeTest;
use crate::signal::outliers::median;
use nalgebra::{DMatrix, DVector};
use std::collections::BTreeMap;

/// Numbers beyond what the loads fix from which they tell the noise.
const TELLING: usize = 24;
/// Readings that a noise told by a median is worth, of its own.
const EFFICIENCY: f64 = 0.37;

/// Noise of displacements, m, and of rotations, rad, each with the readings it is worth, from measured less
/// simulated (rotations times `arm`). `None` where too little is left.
pub(super) fn told(
    test: &CubeTest,
    rows: &[Row],
    missed: &[f64],
    arm: f64,
) -> [Option<(f64, f64)>; 2] {
    let (missed, own_share) = match test.facts.frame_std {
        Some(std) if std > 0.0 => without_shifts(test, rows, missed),
        _ => (missed.to_vec(), 1.0),
    };
    let mut left: [(Vec<f64>, f64); 2] = Default::default();
    for cube in 0..test.facts.cubes.len() {
        for component in 0..6 {
            let own = |r: &Row| r.cube == cube && r.component == component;
            let at: Vec<usize> = (0..rows.len()).filter(|i| own(&rows[*i])).collect();
            let (found, freedom) = beyond_loads(test, rows, &missed, &at);
            let kind = &mut left[component / 3];
            kind.0.extend(found);
            kind.1 += freedom as f64;
        }
    }
    let noise = |(kind, (left, freedom)): (usize, (Vec<f64>, f64))| {
        let sizes: Vec<f64> = left.iter().map(|l| l.abs()).collect();
        let share = (left.len() as f64 / freedom.max(1.0)).sqrt();
        let unit = if kind == 0 { own_share.sqrt() } else { arm };
        let found = median(&sizes) / 0.6745 * share / unit;
        (freedom >= TELLING as f64 && found > 0.0).then_some((found, EFFICIENCY * freedom))
    };
    let mut each = left.into_iter().enumerate().map(noise);
    std::array::from_fn(|_| each.next().flatten())
}

/// Without what all cubes of a test do alike, which a frame that moves makes, and the share of the variance of a cube's own noise that is left of
/// displacements then.
fn without_shifts(test: &CubeTest, rows: &[Row], missed: &[f64]) -> (Vec<f64>, f64) {
    let mut alike: BTreeMap<(i64, usize), Vec<f64>> = BTreeMap::new();
    for (row, missed) in rows.iter().zip(missed) {
        let own = alike.entry((row.test, row.component)).or_default();
        own.push(*missed);
    }
    let shifts: BTreeMap<_, f64> = alike.iter().map(|(at, own)| (*at, mean(own))).collect();
    let less = |(row, missed): (&Row, &f64)| match row.component < 3 {
        true => missed - shifts[&(row.test, row.component)],
        false => *missed,
    };
    match test.facts.cubes.len() {
        0 | 1 => (missed.to_vec(), 1.0),
        cubes => {
            let own = rows.iter().zip(missed).map(less).collect();
            (own, 1.0 - 1.0 / cubes as f64)
        }
    }
}

/// What one component of one cube does that is in no proportion to forces and moments, and how many of its
/// numbers are free.
fn beyond_loads(test: &CubeTest, rows: &[Row], missed: &[f64], at: &[usize]) -> (Vec<f64>, usize) {
    let load = |i: usize, k: usize| {
        let reading = &test.readings[rows[i].reading];
        if k < 3 {
            reading.force[k]
        } else {
            reading.moment[k - 3]
        }
    };
    let acts = |k: &usize| at.iter().any(|i| load(*i, *k) != 0.0);
    let columns: Vec<usize> = (0..6).filter(acts).collect();
    if at.len() <= columns.len() {
        return (Vec::new(), 0);
    }
    if columns.is_empty() {
        // nothing loads them: all that they do is noise
        return (at.iter().map(|i| missed[*i]).collect(), at.len());
    }
    let design = DMatrix::from_fn(at.len(), columns.len(), |i, k| load(at[i], columns[k]));
    let y = DVector::from_iterator(at.len(), at.iter().map(|i| missed[*i]));
    let solved = design.clone().svd(true, true).solve(&y, 1e-9);
    match solved {
        Ok(x) => (
            (y - design * x).as_slice().to_vec(),
            at.len() - columns.len(),
        ),
        Err(_) => (Vec::new(), 0),
    }
}
