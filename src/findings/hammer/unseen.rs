//! What a cause gains on hits that were not fitted.

use super::data::{Data, Pair};
use super::discrepancy::simulated;
use super::map::{Fit, fit};
use super::point::Point;
use super::prediction::Machine;
use super::suspect::{Suspect, same};
use crate::findings::gain::Gain;
use crate::motion::frf::C64;

/// Steps of a refit on some of the hits.
const STEPS: usize = 1;

/// The whole set fitted on some of the hits, and the others.
pub struct Fold {
    fitted: Fit,
    held: Data,
}

/// `chosen` fitted again on part of every fold.
pub fn folds(machine: &Machine, parts: Vec<[Data; 2]>, chosen: &Fit) -> Vec<Fold> {
    let fold = |[some, held]: [Data; 2]| {
        let fitted = fit(machine, &some, chosen.point.clone(), STEPS).ok()?;
        Some(Fold { fitted, held })
    };
    parts.into_iter().filter_map(fold).collect()
}

/// What `suspect` brings on the held-out hits: error without it and with it, what is uncertain
/// although nothing is wrong being where the whole set puts it.
pub fn gain(machine: &Machine, folds: &[Fold], suspect: &Suspect) -> Gain {
    let mut blocks: Vec<[f64; 3]> = Vec::new();
    for fold in folds {
        let whole = &fold.fitted.point;
        let with = errors(machine, &fold.held, whole);
        let without = errors(machine, &fold.held, &without(whole, suspect));
        if let (Some(with), Some(without)) = (with, without) {
            let both = without.iter().zip(&with);
            blocks.extend(both.map(|(b, a)| [b[0], a[0], a[1]]));
        }
    }
    of_blocks(&blocks)
}

/// The set of `chosen` without `suspect`, where it ended.
pub fn without(chosen: &Point, suspect: &Suspect) -> Point {
    chosen.with_only(|own| !same(own, suspect))
}

/// Per pair: weighted sum of squares on held-out hits, and sum of weights.
fn errors(machine: &Machine, held: &Data, point: &Point) -> Option<Vec<[f64; 2]>> {
    let simulated = simulated(machine, held, point).ok()?;
    let pair = |(p, curve): (&Pair, &Vec<C64>)| {
        let mut sums = [0.0; 2];
        for ((h, w), a) in p.frf.iter().zip(&p.weight).zip(curve) {
            sums[0] += w * w * (h - a).norm_sqr();
            sums[1] += w * w;
        }
        sums
    };
    Some(held.pairs.iter().zip(&simulated).map(pair).collect())
}

/// Of blocks of (squares without, squares with, weights): root mean squares, and the jackknife over blocks of the logarithm of their ratio.
pub fn of_blocks(blocks: &[[f64; 3]]) -> Gain {
    let total = |skip: Option<usize>| {
        let kept = blocks.iter().enumerate().filter(|(i, _)| Some(*i) != skip);
        kept.fold([0.0; 3], |s, (_, b)| {
            [s[0] + b[0], s[1] + b[1], s[2] + b[2]]
        })
    };
    let all = total(None);
    let ratio = |s: [f64; 3]| 0.5 * (s[0] / s[1]).ln();
    let left_out: Vec<f64> = (0..blocks.len()).map(|i| ratio(total(Some(i)))).collect();
    let spread = crate::signal::jackknife::variance(&left_out).sqrt();
    let spread = if spread.is_finite() { spread } else { 10.0 };
    let rms = |sum: f64| (sum / all[2].max(f64::MIN_POSITIVE)).sqrt();
    Gain::of(rms(all[0]), rms(all[1]), spread)
}
