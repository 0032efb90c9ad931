//! Errors on cycles that were not fitted, and what naming a cause gains there.

use crate::effects::Composite;
use crate::findings::gain::Gain;
use crate::fit::least_squares::{Problem, minimise};
use crate::fit::observation::Observation;
use crate::ground::stats::difference;
use crate::inference::descent::Stop;
use crate::signal::colour::Colour;

/// Which rows are predicted from which.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Split {
    /// Whole cycles are held out: what repeats must be predicted where it was not seen.
    Cycles,
    /// Pieces of every cycle are held out: for what happens once and is not in every cycle.
    Pieces,
}

/// Most folds: beyond, neighbouring cycles are held out together.
const FOLDS: usize = 4;
/// Pieces per cycle of [`Split::Pieces`].
const PIECES: usize = 8;

/// The fold of every row.
pub fn folds(data: &Observation, split: Split) -> Vec<usize> {
    let n = data.rows();
    let cycles = data.cycles.count();
    match split {
        Split::Cycles if cycles > 1 => data
            .cycles
            .of_row
            .iter()
            .map(|c| c * cycles.min(FOLDS) / cycles)
            .collect(),
        _ => (0..n)
            .map(|i| i * PIECES * cycles / n.max(1) % FOLDS)
            .collect(),
    }
}

/// Prediction error of a model on every row, each row predicted from the folds it is not in.
pub fn held_out(
    model: &Composite,
    start: &[f64],
    data: &Observation,
    colour: &Colour,
    split: Split,
) -> Vec<f64> {
    let mut error = vec![0.0; data.rows()];
    let part = folds(data, split);
    for k in 0..part.iter().max().map_or(1, |m| m + 1) {
        let fold: Vec<bool> = part.iter().map(|p| *p == k).collect();
        let problem = Problem {
            model,
            data,
            colour,
            ignored: &fold,
        };
        let fit = minimise(&problem, start, Stop::at_share(6, 1e-4));
        let predicted = model.predict(&fit.p, &data.scene);
        for i in (0..error.len()).filter(|i| fold[*i]) {
            error[i] = data.reading[i] - predicted[i];
        }
    }
    error
}

/// Gain from errors before and after, row by row. The interval follows from the noise's own
/// fluctuation: with errors a (after) and b = a + d, A = mean a², B = mean b², noise of spectrum s,
/// var A = 2Σs²/n², var B = var A + 4ΣD²s/n², cov = var A, by the delta method on ½ ln(B/A).
pub fn gain(before: &[f64], after: &[f64], data: &Observation) -> Gain {
    let n = before.len() as f64;
    let square = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>() / n;
    let (b, a) = (square(before), square(after).max(f64::MIN_POSITIVE));
    let mut lifted: Vec<f64> = difference(before, after);
    data.cosine.transform(&mut lifted);
    let spectrum = spectrum(after, data);
    let (mut ss, mut ds) = (0.0, 0.0);
    for (s, d) in spectrum.iter().zip(&lifted) {
        ss += s * s;
        ds += d * d * s;
    }
    let (var_a, extra) = (2.0 * ss / (n * n), 4.0 * ds / (n * n));
    let variance = 0.25 * (var_a / (a * a) + (var_a + extra) / (b * b) - 2.0 * var_a / (a * b));
    Gain::of(b.sqrt(), a.sqrt(), variance.max(0.0).sqrt())
}

/// Half width of the smoothing of a periodogram, lines.
const SMOOTHING: usize = 4;

/// Smoothed periodogram of errors: the noise as these errors show it.
fn spectrum(errors: &[f64], data: &Observation) -> Vec<f64> {
    let mut power = errors.to_vec();
    data.cosine.transform(&mut power);
    power.iter_mut().for_each(|c| *c *= *c);
    let n = power.len();
    (0..n)
        .map(|k| {
            let near = &power[k.saturating_sub(SMOOTHING)..(k + SMOOTHING + 1).min(n)];
            near.iter().sum::<f64>() / near.len() as f64
        })
        .collect()
}
