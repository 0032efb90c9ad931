//! Rays through a closed surface of triangles.

use super::grid::Grid;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::V3;

/// Fills the rays of a grid with what lies inside the surface.
///
/// # Errors
/// A ray that enters as often as it leaves is closed; one that does not shows a hole.
pub(super) fn fill(grid: &mut Grid, triangles: &[[V3; 3]]) -> Outcome<()> {
    let mut crossings: Vec<Vec<f64>> = vec![Vec::new(); grid.rays.len()];
    for triangle in triangles {
        cross(grid, triangle, &mut crossings);
    }
    for list in &mut crossings {
        list.sort_by(f64::total_cmp);
    }
    if crossings.iter().any(|list| list.len() % 2 == 1) {
        return Err(Problem::new(
            "the surface of the stock is not closed",
            "export a watertight solid, without holes and without faces inside",
        ));
    }
    let columns = grid.count[0];
    grid.fill(|i, j| pairs(&crossings[j * columns + i]));
    Ok(())
}

fn pairs(list: &[f64]) -> Vec<[f64; 2]> {
    list.as_chunks::<2>().0.to_vec()
}

/// Notes where the rays of a grid pass through one triangle.
fn cross(grid: &Grid, triangle: &[V3; 3], crossings: &mut [Vec<f64>]) {
    let [w, u, v] = grid.axes;
    let flat = triangle.map(|p| [p[u], p[v]]);
    let span = |k: usize| {
        let values = flat.map(|p| p[k]);
        let low = values.iter().copied().fold(f64::INFINITY, f64::min);
        let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        grid.between(k, low, high)
    };
    for j in span(1) {
        for i in span(0) {
            if let Some(share) = shares(&flat, grid.place(i, j)) {
                let at = (0..3).map(|k| share[k] * triangle[k][w]).sum();
                crossings[j * grid.count[0] + i].push(at);
            }
        }
    }
}

/// Barycentric shares of a point inside a flat triangle. A point on an edge belongs to one of the two
/// triangles that share it.
fn shares(flat: &[[f64; 2]; 3], point: [f64; 2]) -> Option<[f64; 3]> {
    let sides = [(1, 2), (2, 0), (0, 1)].map(|(a, b)| side(flat[a], flat[b], point));
    let left = sides.iter().all(|s| s.1);
    let right = sides.iter().all(|s| !s.1);
    let whole: f64 = sides.iter().map(|s| s.0).sum();
    ((left || right) && whole != 0.0).then(|| sides.map(|s| s.0 / whole))
}

/// Twice the signed area of a, b, p, and whether p lies left of a → b; on it: as the edge's direction,
/// which both its triangles see alike.
fn side(a: [f64; 2], b: [f64; 2], p: [f64; 2]) -> (f64, bool) {
    let upward = (a[0], a[1]) < (b[0], b[1]);
    let (low, high) = if upward { (a, b) } else { (b, a) };
    let area = (high[0] - low[0]) * (p[1] - low[1]) - (high[1] - low[1]) * (p[0] - low[0]);
    match upward {
        true => (area, area >= 0.0),
        false => (-area, area < 0.0),
    }
}
