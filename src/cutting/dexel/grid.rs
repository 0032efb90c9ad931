//! All rays of one direction over a rectangle.

use super::ray::Ray;
use super::solid::Solid;
use crate::ground::spatial::V3;

/// Rays parallel to one coordinate axis, in the middles of the cells of a rectangle across it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Grid {
    /// Axis of the rays, and the two across: a right-handed turn of x, y, z.
    pub axes: [usize; 3],
    /// Lower corner, m.
    pub min: V3,
    /// Lower and upper end of the box along the rays, m.
    pub reach: [f64; 2],
    /// Width of the cells across, m.
    pub width: [f64; 2],
    /// Cells per metre across, the reciprocal of the width: a view multiplies where it would divide.
    pub density: [f64; 2],
    /// Number of rays across.
    pub count: [usize; 2],
    /// The rays, the first of the axes across running fastest.
    pub rays: Vec<Ray>,
    /// The upright end that was taken last: what it covered is gone already.
    pub taken: Option<Solid>,
}

/// Share of a cell by which rounding may move a middle over a border.
const TIE: f64 = 1e-6;

impl Grid {
    /// Empty rays along `axis` over the box from `min` to `max`, cells at most `spacing` wide.
    pub fn new(axis: usize, min: V3, max: V3, spacing: f64) -> Self {
        let axes = [axis, (axis + 1) % 3, (axis + 2) % 3];
        let extent = [axes[1], axes[2]].map(|k| max[k] - min[k]);
        let count = extent.map(|e| ((e / spacing).ceil() as usize).max(1));
        Self {
            axes,
            min,
            reach: [min[axis], max[axis]],
            width: [0, 1].map(|k| extent[k] / count[k] as f64),
            density: [0, 1].map(|k| count[k] as f64 / extent[k]),
            count,
            rays: vec![Ray::new(&[]); count[0] * count[1]],
            taken: None,
        }
    }

    /// Place of ray (i, j) across the rays, m.
    pub fn place(&self, i: usize, j: usize) -> [f64; 2] {
        let at = |k: usize, i: usize| self.min[self.axes[k + 1]] + (i as f64 + 0.5) * self.width[k];
        [at(0, i), at(1, j)]
    }

    /// The point of ray (i, j) whose coordinate along the rays is 0.
    pub fn foot(&self, i: usize, j: usize) -> V3 {
        let mut foot = [0.0; 3];
        let [u, v] = self.place(i, j);
        foot[self.axes[1]] = u;
        foot[self.axes[2]] = v;
        foot
    }

    /// Fills every ray with pieces.
    pub fn fill(&mut self, pieces: impl Fn(usize, usize) -> Vec<[f64; 2]>) {
        self.taken = None;
        for j in 0..self.count[1] {
            for i in 0..self.count[0] {
                self.rays[j * self.count[0] + i] = Ray::new(&pieces(i, j));
            }
        }
    }

    /// Rays across direction k (0, 1) whose middles lie between two places.
    pub fn between(&self, k: usize, low: f64, high: f64) -> std::ops::Range<usize> {
        let base = self.min[self.axes[k + 1]];
        let index = |x: f64| ((x - base) / self.width[k] - 0.5).ceil().max(0.0) as usize;
        index(low)..(index(high) + 1).min(self.count[k])
    }

    /// The same rays fewer: cells at most `times` as wide, each with the ray nearest to its middle.
    pub fn coarser(&self, max: V3, times: f64) -> Self {
        let widest = self.width[0].max(self.width[1]);
        let mut coarse = Self::new(self.axes[0], self.min, max, times * widest);
        let near = |k: usize, x: f64| {
            let cell = (x - self.min[self.axes[k + 1]]) * self.density[k];
            // of two that are equally near always the lower one
            ((cell - TIE).max(0.0) as usize).min(self.count[k] - 1)
        };
        for j in 0..coarse.count[1] {
            for i in 0..coarse.count[0] {
                let [u, v] = coarse.place(i, j);
                let own = &self.rays[near(1, v) * self.count[0] + near(0, u)];
                coarse.rays[j * coarse.count[0] + i] = own.clone();
            }
        }
        coarse
    }

    /// Takes a solid away.
    pub fn remove(&mut self, solid: &Solid) {
        match solid.upright() {
            Some(k) => self.remove_upright(solid, k),
            None => self.remove_one_by_one(solid),
        }
    }

    /// Takes a solid away, each ray for itself.
    pub(super) fn remove_one_by_one(&mut self, solid: &Solid) {
        let [w, u, v] = self.axes;
        let (low, high) = solid.bounds();
        let columns = self.between(0, low[u], high[u]);
        for j in self.between(1, low[v], high[v]) {
            for i in columns.clone() {
                let foot = self.foot(i, j);
                if let Some([a, b]) = solid.chord(w, foot) {
                    self.rays[j * self.count[0] + i].subtract(a, b);
                }
            }
        }
    }

    /// Volume in material, m³.
    pub fn volume(&self) -> f64 {
        let length: f64 = self.rays.iter().map(Ray::length).sum();
        length * self.width[0] * self.width[1]
    }
}
