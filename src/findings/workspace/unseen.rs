//! Does a cause help where it was not fitted? Whole points are left out in turn, and predicted.

use super::gram::squared;
use crate::findings::gain::Gain;
use nalgebra::{DMatrix, DVector};

/// Readings with everything linear that may explain them, row by row in standard deviations.
pub struct Rows {
    /// Readings less the simulation.
    pub readings: DVector<f64>,
    /// The springs of the model, then the amounts of causes.
    pub columns: DMatrix<f64>,
    /// Standard deviation of every column before the data.
    pub prior: Vec<f64>,
}

/// The normal matrix with the priors.
fn normal(rows: &Rows) -> DMatrix<f64> {
    let d = &rows.columns;
    let mut normal = squared(d);
    for (i, prior) in rows.prior.iter().enumerate() {
        normal[(i, i)] += prior.powi(-2);
    }
    normal
}

/// What is left of every row when all are fitted.
pub fn fitted(rows: &Rows) -> Vec<f64> {
    let d = &rows.columns;
    let normal = normal(rows);
    let solved = normal
        .cholesky()
        .map(|root| root.solve(&d.tr_mul(&rows.readings)));
    let left = solved.map_or(rows.readings.clone(), |x| &rows.readings - d * x);
    left.iter().copied().collect()
}

/// What is left of every row, predicted without its fold.
pub struct HeldOut {
    /// With the amounts of the causes alone, the springs as they are: what an extended robot predicts.
    pub carried: Vec<f64>,
    /// With the springs moved within their spread too.
    pub refitted: Vec<f64>,
    /// Amounts of the causes fitted without each fold.
    pub amounts: Vec<Vec<f64>>,
}

/// Predicts every fold from the others; rows without a fold are always fitted, and come back as NaN.
/// The first `springs` columns are those of the springs.
pub fn held_out(rows: &Rows, folds: &[Option<usize>], springs: usize) -> HeldOut {
    let d = &rows.columns;
    let normal = normal(rows);
    let gradient = d.tr_mul(&rows.readings);
    let mut out = HeldOut {
        carried: vec![f64::NAN; folds.len()],
        refitted: vec![f64::NAN; folds.len()],
        amounts: Vec::new(),
    };
    let count = folds.iter().flatten().max().map_or(0, |m| m + 1);
    let mut rows_of = vec![Vec::new(); count];
    for (i, fold) in folds.iter().enumerate() {
        fold.iter().for_each(|fold| rows_of[*fold].push(i));
    }
    for own in rows_of {
        let part = d.select_rows(&own);
        let read = rows.readings.select_rows(&own);
        let rest = &normal - part.tr_mul(&part);
        let right = &gradient - part.tr_mul(&read);
        let Some(root) = rest.cholesky() else {
            out.amounts.push(vec![0.0; d.ncols() - springs]);
            continue;
        };
        let mut solved = root.solve(&right);
        let refitted = &read - &part * &solved;
        solved.rows_mut(0, springs).fill(0.0);
        out.amounts
            .push(solved.iter().skip(springs).copied().collect());
        let carried = read - part * solved;
        for (at, i) in own.iter().enumerate() {
            out.refitted[*i] = refitted[at];
            out.carried[*i] = carried[at];
        }
    }
    out
}

/// Gain from what is left before and after; `unit` is the standard deviation of an ordinary
/// reading. With s what the cause changes in the predictions and e the noise, Σ(s + e)² − Σe²
/// scatters by 2|s| about its mean: that is the interval, widened because noise is shared in a set-up.
pub fn gain(before: &[f64], after: &[f64], unit: f64) -> Gain {
    let (mut squares, mut moved, mut rows) = ([0.0; 2], 0.0, 0.0_f64);
    for (b, a) in before.iter().zip(after) {
        if b.is_finite() && a.is_finite() {
            squares[0] += b * b;
            squares[1] += a * a;
            moved += (b - a).powi(2);
            rows += 1.0;
        }
    }
    let noise = (squares[1] / rows.max(1.0)).max(1.0);
    let std = SHARED * (moved * noise).sqrt() / squares[0].max(f64::MIN_POSITIVE);
    let rms = |s: f64| unit * (s / rows.max(1.0)).sqrt();
    Gain::of(
        rms(squares[0]),
        rms(squares[1]).max(f64::MIN_POSITIVE),
        std.min(1e3),
    )
}

/// Noise of rows that belong together counts this much more than of rows that do not.
const SHARED: f64 = 1.3;
