//! What was measured, without its noise.

use super::gram::squared;
use super::patterns::Scene;
use super::seats::{Column, Seats};
use crate::experiments::workspace::Response;
use crate::fit::weighing::Weighing;
use crate::ground::spatial::{M3, V3};

/// With so many parts free at once each is held this much closer: noise must not be fitted.
const NARROW: f64 = 0.2;

/// Slopes without their noise, m/N.
pub struct Smooth {
    /// As they are read.
    pub read: Vec<M3>,
    /// As they are: what instruments act upon.
    pub real: Vec<M3>,
}

/// Slopes close to what was measured: all springs fitted at once with the columns that are `suspect`,
/// or, without any suspicion, with all parts that could give way; each held by its prior.
pub fn smooth(
    scene: &Scene,
    seats: &Seats,
    weighing: &Weighing,
    (response, spread): (&Response, f64),
    suspect: &[usize],
) -> Smooth {
    let part = |i: &usize| {
        let own = &seats.columns[*i];
        let physics = !own.instrument && !own.stranger && own.pattern.left.is_empty();
        suspect.contains(i) || (suspect.is_empty() && physics)
    };
    let parts: Vec<&Column> = (0..seats.columns.len())
        .filter(part)
        .map(|i| &seats.columns[i])
        .collect();
    let springs = weighing.design(response, &response.sites);
    let k = springs.ncols();
    let mut design = springs.resize_horizontally(k + parts.len(), 0.0);
    for (j, part) in parts.iter().enumerate() {
        design.set_column(k + j, &weighing.whiten(|p, d| part.pattern.slopes.at(p)[d]));
    }
    let readings = weighing.measured() - weighing.whiten(|p, d| scene.base.slopes[p][d]);
    let mut normal = squared(&design);
    let width = if suspect.is_empty() { NARROW } else { 1.0 };
    let prior = |j: usize| match j < k {
        true => spread,
        false => width * parts[j - k].prior,
    };
    (0..normal.nrows()).for_each(|j| normal[(j, j)] += prior(j).powi(-2));
    let Some(root) = normal.cholesky() else {
        let same = || scene.base.slopes.clone();
        return Smooth {
            read: same(),
            real: same(),
        };
    };
    let amounts = root.solve(&design.tr_mul(&readings));
    let sites = response.sites.iter().zip(amounts.iter());
    let compliances: Vec<f64> = sites.map(|(s, a)| s.compliance * a).collect();
    let at = |p: usize, d: usize, instruments: bool| -> V3 {
        let own = response.slope(p, d, &compliances);
        let mut sum: V3 = std::array::from_fn(|c| scene.base.slopes[p][d][c] + own[c]);
        for (j, part) in parts.iter().enumerate() {
            if instruments || !part.instrument {
                let own = part.pattern.slopes.at(p)[d];
                (0..3).for_each(|c| sum[c] += amounts[k + j] * own[c]);
            }
        }
        sum
    };
    let all = |instruments: bool| {
        let point = |p: usize| [0, 1, 2].map(|d| at(p, d, instruments));
        (0..scene.points.len()).map(point).collect()
    };
    Smooth {
        read: all(true),
        real: all(false),
    }
}
