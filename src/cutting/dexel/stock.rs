//! The stock of a job: a box or a closed surface, and what is left of it.

use super::depth::depth;
use super::grid::Grid;
use super::mesh;
use super::solid::Solid;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::{V3, add, dot, scale, sub};

/// Material, workpiece frame, m.
#[derive(Debug, Clone, PartialEq)]
pub struct Stock {
    min: V3,
    max: V3,
    cap: f64,
    grids: [Grid; 3],
}

/// How many spacings away a border is still seen.
const SIGHT: f64 = 1.5;
/// Most rays of a stock: about 1.6 GB.
const MOST_RAYS: f64 = 5e7;

impl Stock {
    /// A box with its rays `spacing` apart.
    ///
    /// # Errors
    /// A box without volume; one with too many rays.
    pub fn block(min: V3, max: V3, spacing: f64) -> Outcome<Self> {
        let mut stock = Self::empty(min, max, spacing)?;
        for grid in &mut stock.grids {
            let w = grid.axes[0];
            grid.fill(|_, _| vec![[min[w], max[w]]]);
        }
        Ok(stock)
    }

    /// The inside of a closed surface of triangles with its rays `spacing` apart.
    ///
    /// # Errors
    /// A surface that is not closed, or without volume; one with too many rays.
    pub fn within(triangles: &[[V3; 3]], spacing: f64) -> Outcome<Self> {
        let points = || triangles.iter().flatten();
        let min = [0, 1, 2].map(|k| points().map(|p| p[k]).fold(f64::INFINITY, f64::min));
        let max = [0, 1, 2].map(|k| points().map(|p| p[k]).fold(f64::NEG_INFINITY, f64::max));
        let mut stock = Self::empty(min, max, spacing)?;
        for grid in &mut stock.grids {
            mesh::fill(grid, triangles)?;
        }
        Ok(stock)
    }

    fn empty(min: V3, max: V3, spacing: f64) -> Outcome<Self> {
        let extent = sub(max, min);
        let solid = extent.iter().all(|e| *e > 0.0 && e.is_finite());
        if !solid || spacing.is_nan() || spacing <= 0.0 {
            return Err(Problem::new(
                "the stock has no volume",
                "give `stock_min_mm` below `stock_max_mm` in x, y and z",
            ));
        }
        let [x, y, z] = extent.map(|e| e / spacing);
        if x * y + y * z + z * x > MOST_RAYS {
            return Err(Problem::new(
                "the stock is too large for the tool",
                "give only the part of the stock that the path cuts",
            ));
        }
        Ok(Self {
            min,
            max,
            cap: SIGHT * spacing,
            grids: [0, 1, 2].map(|w| Grid::new(w, min, max, spacing)),
        })
    }

    /// The same material with its rays `times` as far apart.
    pub fn coarser(&self, times: f64) -> Self {
        Self {
            cap: times * self.cap,
            grids: [0, 1, 2].map(|k| self.grids[k].coarser(self.max, times)),
            ..*self
        }
    }

    /// Lower and upper corner of the stock as it was.
    pub fn bounds(&self) -> (V3, V3) {
        (self.min, self.max)
    }

    /// Distance of the rays, m.
    pub fn spacing(&self) -> f64 {
        self.cap / SIGHT
    }

    /// Takes the tool's solid away.
    pub fn remove(&mut self, solid: &Solid) {
        if self.meets(solid, 0.0) {
            self.grids.iter_mut().for_each(|grid| grid.remove(solid));
        }
    }

    /// Whether a solid comes within `margin` of the box around the stock.
    pub fn meets(&self, solid: &Solid, margin: f64) -> bool {
        let (low, high) = solid.bounds();
        (0..3).all(|k| high[k] > self.min[k] - margin && low[k] < self.max[k] + margin)
    }

    /// Highest point of the box above `tip` along `axis`.
    pub fn height_above(&self, tip: V3, axis: V3) -> f64 {
        let reach = |k: usize| (self.max[k] * axis[k]).max(self.min[k] * axis[k]);
        reach(0) + reach(1) + reach(2) - dot(tip, axis)
    }

    /// Volume of each direction's rays, m³. They differ by how their spacing meets the walls.
    pub fn volumes(&self) -> [f64; 3] {
        [0, 1, 2].map(|k| self.grids[k].volume())
    }

    /// How deep a point lies in the material, m: positive inside, at most 1.5 spacings either way.
    /// Exact for planes across a direction of rays; of second order in the spacing for others.
    pub fn depth(&self, point: V3) -> f64 {
        let far = |k: usize| point[k] < self.min[k] - self.cap || point[k] > self.max[k] + self.cap;
        if (0..3).any(far) {
            return -self.cap;
        }
        depth(&self.grids, point, self.cap)
    }

    /// Points of the surface across one axis: where the rays along it end first from above, with
    /// their depth below the top, m. For pictures of what is left.
    pub fn relief(&self, axis: usize) -> Vec<(V3, f64)> {
        let grid = &self.grids[axis];
        let mut points = Vec::new();
        for j in 0..grid.count[1] {
            for i in 0..grid.count[0] {
                if let Some([_, top]) = grid.rays[j * grid.count[0] + i].pieces().last() {
                    let mut along = [0.0; 3];
                    along[axis] = 1.0;
                    let place = add(grid.foot(i, j), scale(top, along));
                    points.push((place, self.max[axis] - top));
                }
            }
        }
        points
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MM: f64 = 1e-3;

    fn slot() -> Stock {
        let mut stock = Stock::block([0.0; 3], [30.0 * MM, 20.0 * MM, 6.0 * MM], 0.4 * MM).unwrap();
        for i in 0..=200 {
            stock.remove(&Solid {
                radius: 5.03 * MM,
                corner: 0.0,
                length: 30.0 * MM,
                tip: [0.1 * MM * f64::from(i), 10.07 * MM, 3.93 * MM],
                axis: [0.0, 0.0, 1.0],
            });
        }
        stock
    }

    #[test]
    fn with_fewer_rays_it_is_the_same_material() {
        let stock = slot();
        let coarse = stock.coarser(2.0);
        assert!((coarse.spacing() - 2.0 * stock.spacing()).abs() < 1e-12);
        assert_eq!(coarse.bounds(), stock.bounds());
        for (few, many) in coarse.volumes().iter().zip(stock.volumes()) {
            assert!((few / many - 1.0).abs() < 0.05, "{few} {many}");
        }
        for p in [[3.3, 3.1, 0.3], [3.3, 10.0, 3.5], [10.0, 10.0, 4.2]] {
            let apart = coarse.depth(p.map(|x| x * MM)) - stock.depth(p.map(|x| x * MM));
            assert!(apart.abs() < 0.01 * MM, "{apart} at {p:?}");
        }
    }

    #[test]
    fn depth_is_exact_across_faces_and_near_edges() {
        let stock = slot();
        let at = |p: V3| stock.depth(p.map(|x| x * MM)) / MM;
        assert!(
            (at([3.3, 3.1, 0.21]) - 0.21).abs() < 1e-9,
            "bottom of the block"
        );
        assert!(
            (at([10.2, 10.0, 3.83]) - 0.1).abs() < 1e-9,
            "floor of the slot"
        );
        assert!(
            (at([10.2, 15.25, 5.1]) - 0.15).abs() < 1e-9,
            "wall of the slot"
        );
        assert!(
            (at([10.2, 15.25, 5.95]) - 0.05).abs() < 1e-9,
            "its upper edge"
        );
        assert!(
            (at([10.2, 15.05, 3.9]) - 0.03).abs() < 0.06,
            "its lower edge"
        );
        assert!(at([10.2, 12.0, 4.5]) < -0.3, "in the slot");
        assert!(at([10.2, 12.0, 6.5]) < -0.3, "above the block");
    }

    #[test]
    fn a_box_of_triangles_is_a_box() {
        let corner = |i: usize| [0, 1, 2].map(|k| if i >> k & 1 == 1 { 10.0 * MM } else { 0.0 });
        let faces = [
            [0, 2, 3, 1],
            [4, 5, 7, 6],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 4, 6, 2],
            [1, 3, 7, 5],
        ];
        let triangles: Vec<[V3; 3]> = faces
            .iter()
            .flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]])
            .map(|t| t.map(corner))
            .collect();
        let mesh = Stock::within(&triangles, 0.5 * MM).unwrap();
        let block = Stock::block([0.0; 3], [10.0 * MM; 3], 0.5 * MM).unwrap();
        for (a, b) in mesh.volumes().iter().zip(block.volumes()) {
            assert!((a / b - 1.0).abs() < 1e-12);
        }
        let open = &triangles[..11];
        assert!(Stock::within(open, 0.5 * MM).is_err());
    }
}
