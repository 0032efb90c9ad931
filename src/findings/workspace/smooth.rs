//! What was measured, without its noise.

use super::patterns::Scene;
use super::seats::{Column, Seats};
use crate::experiments::workspace::Response;
use crate::fit::weighing::Weighing;
use crate::ground::spatial::{M3, V3};

/// Slopes close to what was measured, without its noise: all springs and all parts that could give
/// way fitted at once, each held by its prior, with the instruments that are `suspect`.
pub fn smooth(
    scene: &Scene,
    seats: &Seats,
    weighing: &Weighing,
    (response, spread): (&Response, f64),
    suspect: &[usize],
) -> Vec<M3> {
    let part = |i: &usize| {
        let own = &seats.columns[*i];
        let physics = !own.instrument && !own.stranger && own.pattern.left.is_empty();
        physics || suspect.contains(i)
    };
    let parts: Vec<&Column> = (0..seats.columns.len())
        .filter(part)
        .map(|i| &seats.columns[i])
        .collect();
    let springs = weighing.design(response, &response.sites);
    let k = springs.ncols();
    let mut design = springs.resize_horizontally(k + parts.len(), 0.0);
    for (j, part) in parts.iter().enumerate() {
        design.set_column(k + j, &part.pattern.weighed(weighing, 0));
    }
    let readings = weighing.measured() - weighing.whiten(|p, d| scene.base.slopes[p][d]);
    let mut normal = design.tr_mul(&design);
    let prior = |j: usize| if j < k { spread } else { parts[j - k].prior };
    (0..normal.nrows()).for_each(|j| normal[(j, j)] += prior(j).powi(-2));
    let Some(root) = normal.cholesky() else {
        return scene.base.slopes.clone();
    };
    let amounts = root.solve(&design.tr_mul(&readings));
    let sites = response.sites.iter().zip(amounts.iter());
    let compliances: Vec<f64> = sites.map(|(s, a)| s.compliance * a).collect();
    let at = |p: usize, d: usize| -> V3 {
        let own = response.slope(p, d, &compliances);
        let mut sum: V3 = std::array::from_fn(|c| scene.base.slopes[p][d][c] + own[c]);
        for (j, part) in parts.iter().enumerate() {
            (0..3).for_each(|c| sum[c] += amounts[k + j] * part.pattern.slopes[p][d][c]);
        }
        sum
    };
    let point = |p: usize| [0, 1, 2].map(|d| at(p, d));
    (0..scene.points.len()).map(point).collect()
}

/// Length of a vector.
pub fn norm(v: &V3) -> f64 {
    (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt()
}
