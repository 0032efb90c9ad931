//! A square end whose axis lies along one direction of the rays: what it takes is known row by row,
//! without asking ray by ray.

use super::grid::Grid;
use super::solid::Solid;
use std::ops::Range;

impl Solid {
    /// The coordinate axis along which a square end stands, if it does.
    pub(super) fn upright(&self) -> Option<usize> {
        let along = (0..3).find(|k| self.axis[*k].abs() == 1.0);
        along.filter(|_| self.corner == 0.0)
    }

    /// Lowest and highest coordinate of an upright end along its axis `k`.
    fn span(&self, k: usize) -> [f64; 2] {
        let top = self.tip[k] + self.length * self.axis[k];
        [self.tip[k].min(top), self.tip[k].max(top)]
    }

    /// Whether this end, standing along axis `k`, reaches as low and as high as another within the box.
    fn covers(&self, other: &Self, k: usize, [bottom, top]: [f64; 2]) -> bool {
        let ([low, high], [lowest, highest]) = (self.span(k), other.span(k));
        let upright = [self, other].iter().all(|s| s.upright() == Some(k));
        upright && low <= lowest.max(bottom) && high >= highest.min(top)
    }

    /// Half the chord across the axis at a distance from it.
    fn half_chord(&self, off: f64) -> Option<f64> {
        let square = self.radius * self.radius - off * off;
        (square > 0.0).then(|| square.sqrt())
    }
}

impl Grid {
    /// Takes an end away that stands along coordinate axis `k`.
    pub(super) fn remove_upright(&mut self, solid: &Solid, k: usize) {
        match self.axes.iter().position(|axis| *axis == k) {
            Some(0) => self.remove_lengthwise(solid),
            Some(along) => self.remove_across(solid, along - 1),
            None => {}
        }
    }

    /// Rays along the tool.
    fn remove_lengthwise(&mut self, solid: &Solid) {
        let [w, u, v] = self.axes;
        let [low, high] = solid.span(w);
        let (middle, r) = (solid.tip[v], solid.radius);
        let before = self.taken.replace(*solid);
        let before = before.filter(|before| before.covers(solid, w, self.reach));
        for j in self.within(1, middle - r, middle + r) {
            let place = self.min[v] + (j as f64 + 0.5) * self.width[1];
            let Some(half) = solid.half_chord(place - middle) else {
                continue;
            };
            let row = j * self.count[0];
            let all = self.within(0, solid.tip[u] - half, solid.tip[u] + half);
            let gone = before.and_then(|before| {
                let half = before.half_chord(place - before.tip[v])?;
                Some(self.within(0, before.tip[u] - half, before.tip[u] + half))
            });
            for i in without(all, gone).into_iter().flatten() {
                self.rays[row + i].subtract(low, high);
            }
        }
    }

    /// Rays across the tool, whose axis is the one `along` (0, 1) of the two across the rays.
    fn remove_across(&mut self, solid: &Solid, along: usize) {
        let (w, other) = (self.axes[0], 1 - along);
        let [low, high] = solid.span(self.axes[along + 1]);
        let heights = self.within(along, low, high);
        let (axis, r) = (self.axes[other + 1], solid.radius);
        for i in self.within(other, solid.tip[axis] - r, solid.tip[axis] + r) {
            let off = self.min[axis] + (i as f64 + 0.5) * self.width[other] - solid.tip[axis];
            let Some(half) = solid.half_chord(off) else {
                continue;
            };
            let [a, b] = [solid.tip[w] - half, solid.tip[w] + half];
            for h in heights.clone() {
                let at = if along == 0 { [h, i] } else { [i, h] };
                self.rays[at[1] * self.count[0] + at[0]].subtract(a, b);
            }
        }
    }

    /// Rays across direction `k` (0, 1) whose middles lie within two places.
    fn within(&self, k: usize, low: f64, high: f64) -> std::ops::Range<usize> {
        let cells = |x: f64| (x - self.min[self.axes[k + 1]]) / self.width[k] - 0.5;
        let end = (cells(high).floor() + 1.0).clamp(0.0, self.count[k] as f64) as usize;
        (cells(low).ceil().max(0.0) as usize).min(end)..end
    }
}

/// What of a range lies outside of another, below and above it.
fn without(all: Range<usize>, gone: Option<Range<usize>>) -> [Range<usize>; 2] {
    match gone.filter(|g| !g.is_empty()) {
        None => [all, 0..0],
        Some(gone) => {
            let (below, above) = (
                all.start..all.end.min(gone.start),
                all.start.max(gone.end)..all.end,
            );
            [below, above]
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ground::spatial::V3;

    #[test]
    fn row_by_row_is_ray_by_ray() {
        for axis in [
            [0.0, 0.0, 1.0],
            [0.0, 0.0, -1.0],
            [1.0, 0.0, 0.0],
            [0.0, -1.0, 0.0],
        ] {
            for along in 0..3 {
                let whole = Grid::new(along, [0.0; 3], [21.3, 17.9, 9.7], 0.41);
                let mut rows = whole.clone();
                rows.fill(|_, _| vec![[0.0, 30.0]]);
                let mut rays = rows.clone();
                let before = rays.volume();
                let near = [
                    [5.03, 4.07, 3.11],
                    [5.33, 4.47, 3.11],
                    [5.33, 3.1, 3.6],
                    [8.1, 3.4, 3.6],
                ];
                let far = [[8.1, 3.4, 2.9], [19.9, 16.2, 8.8], [-2.0, 9.0, 1.0_f64]];
                for tip in near.into_iter().chain(far) {
                    let tip: V3 = tip;
                    let solid = Solid {
                        radius: 4.1,
                        corner: 0.0,
                        length: 6.2,
                        tip,
                        axis,
                    };
                    rays.remove_one_by_one(&solid);
                    rows.remove(&solid);
                }
                let apart = (rows.volume() - rays.volume()).abs();
                assert!(apart < 1e-9 * rays.volume(), "{axis:?} {along}: {apart}");
                assert!(rays.volume() < before);
            }
        }
    }
}
