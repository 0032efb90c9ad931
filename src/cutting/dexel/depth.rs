//! How deep a point lies in the stock, from the rays around it, finer than their spacing.

use super::grid::Grid;
use crate::ground::spatial::V3;

/// What the four rays around a point say in one direction.
#[derive(Debug, Clone, Copy, Default)]
struct View {
    /// Distance to the border across it, where all four see the same one, and its squared slope.
    plane: Option<(f64, f64)>,
    /// Sum of weight times distance, and of weights, of the rays that see a border.
    seen: (f64, f64),
    /// Weight of rays deep inside less that of rays far outside.
    beyond: f64,
}

/// Steeper surfaces are seen better by another direction.
const STEEP: f64 = 1.5;
/// A ray at the edge of its cell still has this weight.
const LEAST: f64 = 1e-3;

/// Looks at a point along the rays of one grid; borders farther than `cap` (m) are not seen.
#[inline]
fn view(grid: &Grid, point: V3, cap: f64) -> View {
    let [w, u, v] = grid.axes;
    let (i, s) = cell(point[u] - grid.min[u], grid.density[0]);
    let (j, t) = cell(point[v] - grid.min[v], grid.density[1]);
    let at = |i: i64, j: i64| border(grid, i, j, point[w], cap);
    let four = [at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)];
    let weights = [(1.0 - s) * (1.0 - t), s * (1.0 - t), (1.0 - s) * t, s * t];
    let mut view = View::default();
    for ((distance, slope), weight) in four.iter().zip(weights) {
        let weight = weight.max(LEAST);
        match *slope == 0.0 {
            true => view.beyond += weight.copysign(*distance),
            false => {
                view.seen.0 += weight * distance;
                view.seen.1 += weight;
            }
        }
    }
    if four[0].1 != 0.0 && four.iter().all(|f| f.1 == four[0].1) {
        view.plane = Some(plane(&four.map(|f| f.0), (s, t), grid.density));
    }
    view
}

/// Index of the lower of two neighbouring middles, and the share of the way to the upper.
#[inline]
fn cell(from: f64, density: f64) -> (i64, f64) {
    let x = from * density - 0.5;
    // the next whole number below: rounding by conversion costs a third of a call
    let whole = x as i64;
    let low = whole - i64::from(whole as f64 > x);
    (low, x - low as f64)
}

#[inline]
fn border(grid: &Grid, i: i64, j: i64, at: f64, cap: f64) -> (f64, f64) {
    // what lies below zero comes out far above the count
    let (i, j) = (i as usize, j as usize);
    match i < grid.count[0] && j < grid.count[1] {
        true => grid.rays[j * grid.count[0] + i].border(at, cap),
        false => (-cap, 0.0),
    }
}

/// Distance across the surface that four distances along the rays span, and its squared slope.
#[inline]
fn plane(four: &[f64; 4], (s, t): (f64, f64), density: [f64; 2]) -> (f64, f64) {
    let [a, b, c, d] = *four;
    let (low, high) = (a + s * (b - a), c + s * (d - c));
    let along = ((b - a) * (1.0 - t) + (d - c) * t) * density[0];
    let across = (high - low) * density[1];
    let square = along * along + across * across;
    ((low + t * (high - low)) / (1.0 + square).sqrt(), square)
}

/// Directions in the order in which they are asked: most tools stand along z, and most points near what they cut see its upper face or
/// its floor straight across.
const ASKED: [usize; 3] = [2, 0, 1];

/// One depth from the three directions, m: positive in material, at most `cap`. A direction that sees a
/// surface straight across it has said all: the others are not asked.
///
/// Where a direction sees one surface with all four rays, the least steep says it. At an edge no
/// direction does: the rays that see a face speak for it, the nearest face counts where the rest is
/// air, the farthest where the rest is material.
pub(super) fn depth(grids: &[Grid; 3], point: V3, cap: f64) -> f64 {
    let mut views = [View::default(); 3];
    for k in ASKED {
        views[k] = view(&grids[k], point, cap);
        if let Some((distance, 0.0)) = views[k].plane {
            return distance.clamp(-cap, cap);
        }
    }
    of_views(&views, cap)
}

fn of_views(views: &[View; 3], cap: f64) -> f64 {
    let planes = views.iter().filter_map(|v| v.plane);
    let best = planes.min_by(|a, b| a.1.total_cmp(&b.1));
    if let Some((distance, square)) = best
        && square < STEEP
    {
        return distance.clamp(-cap, cap);
    }
    let faces = views.iter().filter(|v| v.seen.1 > 0.0);
    let faces = faces.map(|v| v.seen.0 / v.seen.1);
    // rays within a wall do not know how near the point is to it: another direction does
    let is_seen = views.iter().any(|v| v.seen.1 > 0.0);
    let alone = |v: &&View| v.seen.1 == 0.0 && (v.beyond < -0.99 || v.beyond > 0.99 && !is_seen);
    if let Some(view) = views.iter().find(alone) {
        return cap.copysign(view.beyond);
    }
    let beyond: f64 = views.iter().map(|v| v.beyond).sum();
    match beyond < 0.0 {
        true => faces.fold(cap, f64::min),
        false => faces.fold(-cap, f64::max),
    }
}
