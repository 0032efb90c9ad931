//! What a cause gains on hits that were not fitted.

use super::data::Data;
use super::map::{Fit, fit};
use super::prediction::{Machine, Point, Suspect};
use super::search::same;
use crate::findings::gain::Gain;

/// Steps of a refit on some of the hits.
const STEPS: usize = 2;

/// Weighted sums of squares of the errors on held-out hits, one per pair and fold, with their weights.
type Blocks = Vec<[f64; 3]>;

/// The gain of `suspect` in `chosen`, the fit without it being `reduced`; folds are fitted and held out.
pub fn gain(machine: &Machine, folds: &[[Data; 2]], chosen: &Fit, reduced: &Fit) -> Gain {
    let mut blocks: Blocks = Vec::new();
    for [fitted, held] in folds {
        let with = errors(machine, fitted, held, &chosen.point);
        let without = errors(machine, fitted, held, &reduced.point);
        if let (Some(with), Some(without)) = (with, without) {
            let both = without.iter().zip(&with);
            blocks.extend(both.map(|(b, a)| [b[0], a[0], a[1]]));
        }
    }
    of_blocks(&blocks)
}

/// The set of `chosen` without `suspect`, where it ended.
pub fn without(chosen: &Point, suspect: &Suspect) -> Point {
    let mut point = Point::nothing();
    point.theta.clone_from(&chosen.theta);
    for (own, amounts) in chosen.each() {
        if !same(own, suspect) {
            let scaled: Vec<f64> = amounts
                .iter()
                .zip(own.spreads())
                .map(|(a, s)| a / s)
                .collect();
            point = point.and(own, &scaled);
        }
    }
    point
}

/// Per pair: weighted sum of squares on held-out hits, and sum of weights.
fn errors(machine: &Machine, fitted: &Data, held: &Data, start: &Point) -> Option<Vec<[f64; 2]>> {
    let found = fit(machine, fitted, start.clone(), STEPS).ok()?;
    let predicted = machine.predict(&found.nuisance, &found.point, held).ok()?;
    let pair = |p: &super::data::Pair| {
        let mut sums = [0.0; 2];
        for ((h, w), a) in p.frf.iter().zip(&p.weight).zip(&predicted) {
            sums[0] += w * w * (h - a[p.output][p.input]).norm_sqr();
            sums[1] += w * w;
        }
        sums
    };
    Some(held.pairs.iter().map(pair).collect())
}

/// Root mean squares and the jackknife over blocks of the logarithm of their ratio.
fn of_blocks(blocks: &Blocks) -> Gain {
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
