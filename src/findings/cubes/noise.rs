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
/// Share of the greatest singular value from which a direction of the loads counts.
const ROUNDING: f64 = 1e-9;
/// Share of a reading's own noise from which it is told by what the loads leave.
const FOLLOWED: f64 = 1e-3;

/// Noise of displacements, m, and of rotations, rad, each with the readings it is worth, from measured less
/// simulated (rotations times `arm`). `None` where too little is left.
pub(super) fn told(
    test: &CubeTest,
    rows: &[Row],
    missed: &[f64],
    arm: f64,
) -> [Option<(f64, f64)>; 2] {
    let (missed, free) = match test.facts.frame_std {
        Some(std) if std > 0.0 => without_shifts(rows, missed),
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
        let (unit, free) = if kind == 0 { (1.0, free) } else { (arm, 1.0) };
        let found = median(&sizes) / 0.6745 / unit;
        let worth = free * freedom;
        (worth >= TELLING as f64 && found > 0.0).then_some((found, EFFICIENCY * worth))
    };
    let mut each = left.into_iter().enumerate().map(noise);
    std::array::from_fn(|_| each.next().flatten())
}

/// Without what all cubes of a test do alike, which a frame that moves makes, so large that each keeps the variance of its own noise, and the share
/// of their numbers that is left of displacements then. One cube alone keeps what it does.
fn without_shifts(rows: &[Row], missed: &[f64]) -> (Vec<f64>, f64) {
    let mut alike: BTreeMap<(i64, usize), Vec<f64>> = BTreeMap::new();
    let shifts = |row: &&(&Row, &f64)| row.0.component < 3;
    let all: Vec<(&Row, &f64)> = rows.iter().zip(missed).collect();
    for (row, missed) in all.iter().filter(shifts) {
        let own = alike.entry((row.test, row.component)).or_default();
        own.push(**missed);
    }
    let less = |(row, missed): &(&Row, &f64)| match alike.get(&(row.test, row.component)) {
        Some(own) if own.len() > 1 => {
            let kept = 1.0 - 1.0 / own.len() as f64;
            (*missed - mean(own)) / kept.sqrt()
        }
        _ => **missed,
    };
    let count: usize = alike.values().map(Vec::len).sum();
    let free = count - alike.values().filter(|own| own.len() > 1).count();
    let share = free as f64 / count.max(1) as f64;
    (all.iter().map(less).collect(), share)
}

/// What one component of one cube does that is in no proportion to forces and moments, each of the variance of its own noise, and how
/// many of its numbers are free.
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
    if columns.is_empty() {
        // nothing loads them: all that they do is noise
        return (at.iter().map(|i| missed[*i]).collect(), at.len());
    }
    let design = DMatrix::from_fn(at.len(), columns.len(), |i, k| load(at[i], columns[k]));
    let svd = design.svd(true, false);
    let Some(own) = svd.u else {
        return (Vec::new(), 0);
    };
    let least = ROUNDING * svd.singular_values.max();
    let acting = (0..own.ncols()).filter(|k| svd.singular_values[*k] > least);
    let own = own.select_columns(&acting.collect::<Vec<_>>());
    if at.len() <= own.ncols() {
        return (Vec::new(), 0);
    }
    let y = DVector::from_iterator(at.len(), at.iter().map(|i| missed[*i]));
    let left = &y - &own * own.tr_mul(&y);
    // a load of its own is followed whatever is read there
    let free = |i: usize| 1.0 - own.row(i).norm_squared();
    let told = (0..at.len()).filter(|i| free(*i) > FOLLOWED);
    (
        told.map(|i| left[i] / free(i).sqrt()).collect(),
        at.len() - own.ncols(),
    )
}
