//! The tool at one place as a solid of revolution, and where rays pass through it.

use crate::cutting::tool::Tool;
use crate::ground::spatial::{V3, add, dot, scale, sub};

/// A square, bull or ball end with its shaft. Lengths in m, workpiece frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Solid {
    /// Radius of the shaft.
    pub radius: f64,
    /// Radius of the corner.
    pub corner: f64,
    /// Length from the tip.
    pub length: f64,
    /// The tip.
    pub tip: V3,
    /// Unit vector of the axis, from the tip into the spindle.
    pub axis: V3,
}

/// Below this share of a turn a ray counts as parallel to the tool, or across it.
const STRAIGHT: f64 = 1e-9;

impl Solid {
    /// What the tool sweeps by turning, its flutes being `length` long.
    pub fn of(tool: &Tool, length: f64, tip: V3, axis: V3) -> Self {
        Self {
            radius: tool.radius_m,
            corner: tool.corner_radius_m,
            length,
            tip,
            axis,
        }
    }

    /// Lower and upper corner of a box around it.
    pub fn bounds(&self) -> (V3, V3) {
        let top = add(self.tip, scale(self.length, self.axis));
        let wide = |k: usize| self.radius * (1.0 - self.axis[k].powi(2)).max(0.0).sqrt();
        (
            [0, 1, 2].map(|k| self.tip[k].min(top[k]) - wide(k)),
            [0, 1, 2].map(|k| self.tip[k].max(top[k]) + wide(k)),
        )
    }

    /// Whether a point lies deeper than `depth` inside its side and bottom.
    pub fn holds(&self, point: V3, depth: f64) -> bool {
        let from = sub(point, self.tip);
        let z = dot(from, self.axis);
        let across = (dot(from, from) - z * z).max(0.0);
        self.reach(z, depth).is_some_and(|r| across < r * r)
    }

    /// Radius of what lies deeper than `depth` inside at height `z` above the tip, m; `None` where
    /// nothing does.
    pub(super) fn reach(&self, z: f64, depth: f64) -> Option<f64> {
        if z < depth || z > self.length {
            return None;
        }
        let (rise, r) = (self.corner - z, self.corner - depth);
        let reach = match z < self.corner {
            false => self.radius - depth,
            true if r > rise => self.radius - self.corner + (r * r - rise * rise).max(0.0).sqrt(),
            true => return None,
        };
        (reach > 0.0).then_some(reach)
    }

    /// Radius at height z above the tip.
    fn radius_at(&self, z: f64) -> f64 {
        let rise = (self.corner - z).max(0.0);
        self.radius - self.corner + (self.corner.powi(2) - rise * rise).max(0.0).sqrt()
    }

    /// Where the ray along coordinate axis `w` through `foot` is inside: its lowest and highest
    /// coordinate. The solid is convex: one piece.
    pub fn chord(&self, w: usize, foot: V3) -> Option<[f64; 2]> {
        let from = sub(foot, self.tip);
        let line = Line::new(from, self.axis, w);
        if line.square < STRAIGHT {
            return self.lengthwise(&line);
        }
        if line.rise.abs() < STRAIGHT {
            let within = (0.0..=self.length).contains(&line.z);
            return within.then(|| line.within(self.radius_at(line.z)))?;
        }
        let side = line.within(self.radius);
        let shaft = side.and_then(|s| meet(s, line.heights(self.corner, self.length)));
        if self.corner == 0.0 {
            return shaft;
        }
        let end = match self.corner == self.radius {
            true => line.ball(self.corner, self.corner),
            false => self.bull(&line),
        };
        join(shaft, end)
    }

    /// A ray parallel to the axis.
    fn lengthwise(&self, line: &Line) -> Option<[f64; 2]> {
        let across = line.across.max(0.0).sqrt();
        if across > self.radius {
            return None;
        }
        let over = (across - (self.radius - self.corner)).max(0.0);
        let bottom = self.corner - (self.corner.powi(2) - over * over).max(0.0).sqrt();
        Some(line.heights(bottom, self.length))
    }

    /// The round end: everything within the corner's radius of a flat disc. The distance is convex
    /// along the ray: its least place by golden section, its borders by halving.
    fn bull(&self, line: &Line) -> Option<[f64; 2]> {
        let flat = self.radius - self.corner;
        let distance = |t: f64| {
            let (across, z) = line.at(t);
            (across - flat).max(0.0).hypot(z - self.corner)
        };
        let middle = -line.lean / line.square;
        let reach = self.radius + self.corner + middle.abs() + line.z.abs();
        let (mut low, mut high) = (middle - 2.0 * reach, middle + 2.0 * reach);
        let (outer_low, outer_high) = (low, high);
        for _ in 0..60 {
            let (a, b) = (
                high - 0.618_033_988_75 * (high - low),
                low + 0.618_033_988_75 * (high - low),
            );
            match distance(a) < distance(b) {
                true => high = b,
                false => low = a,
            }
        }
        let best = 0.5 * (low + high);
        if distance(best) >= self.corner {
            return None;
        }
        let border = |mut outside: f64| {
            let mut inside = best;
            for _ in 0..50 {
                let t = 0.5 * (inside + outside);
                match distance(t) < self.corner {
                    true => inside = t,
                    false => outside = t,
                }
            }
            inside
        };
        Some([border(outer_low), border(outer_high)])
    }
}

/// A ray seen from the tool: height z + rise t, squared distance from the axis square t² + 2 lean t + across.
struct Line {
    z: f64,
    rise: f64,
    square: f64,
    lean: f64,
    across: f64,
}

impl Line {
    fn new(from: V3, axis: V3, w: usize) -> Self {
        let (z, rise) = (dot(from, axis), axis[w]);
        Self {
            z,
            rise,
            square: 1.0 - rise * rise,
            lean: from[w] - z * rise,
            across: dot(from, from) - z * z,
        }
    }

    /// Distance from the axis, and height.
    fn at(&self, t: f64) -> (f64, f64) {
        let across = (self.square * t + 2.0 * self.lean) * t + self.across;
        (across.max(0.0).sqrt(), self.z + self.rise * t)
    }

    /// Within a distance of the axis.
    fn within(&self, radius: f64) -> Option<[f64; 2]> {
        roots(self.square, self.lean, self.across - radius * radius)
    }

    /// Within a ball whose centre lies on the axis.
    fn ball(&self, radius: f64, height: f64) -> Option<[f64; 2]> {
        let z = self.z - height;
        let lean = self.lean + z * self.rise;
        roots(1.0, lean, self.across + z * z - radius * radius)
    }

    /// Between two heights.
    fn heights(&self, low: f64, high: f64) -> [f64; 2] {
        let [a, b] = [low, high].map(|h| (h - self.z) / self.rise);
        [a.min(b), a.max(b)]
    }
}

/// Where a t² + 2 b t + c < 0.
fn roots(a: f64, b: f64, c: f64) -> Option<[f64; 2]> {
    let square = b * b - a * c;
    let root = (square > 0.0).then(|| square.sqrt())?;
    Some([(-b - root) / a, (-b + root) / a])
}

fn meet(a: [f64; 2], b: [f64; 2]) -> Option<[f64; 2]> {
    let both = [a[0].max(b[0]), a[1].min(b[1])];
    (both[0] < both[1]).then_some(both)
}

fn join(a: Option<[f64; 2]>, b: Option<[f64; 2]>) -> Option<[f64; 2]> {
    match (a, b) {
        (Some(a), Some(b)) => Some([a[0].min(b[0]), a[1].max(b[1])]),
        (a, b) => a.or(b),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn solid(corner: f64, axis: V3) -> Solid {
        Solid {
            radius: 8.0,
            corner,
            length: 30.0,
            tip: [1.0, 2.0, 3.0],
            axis,
        }
    }

    /// A ray by trying points along it.
    fn tried(solid: &Solid, w: usize, foot: V3) -> Option<[f64; 2]> {
        let at = |i: usize| -60.0 + 0.002 * i as f64;
        let inside = |i: &usize| {
            let mut point = foot;
            point[w] = at(*i);
            solid.holds(point, 0.0)
        };
        let first = (0..60_000).find(inside)?;
        let last = (0..60_000).rev().find(inside)?;
        Some([at(first), at(last)])
    }

    #[test]
    fn chords_are_where_points_are_inside() {
        let tilted = crate::ground::spatial::unit([0.3, -0.2, 0.9]).unwrap();
        for corner in [0.0, 2.0, 8.0] {
            for axis in [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], tilted] {
                let solid = solid(corner, axis);
                for (w, foot) in [
                    (0, [0.0, 4.0, 5.0]),
                    (1, [3.0, 0.0, 3.7]),
                    (2, [5.0, 6.0, 0.0]),
                ] {
                    let (fast, slow) = (solid.chord(w, foot), tried(&solid, w, foot));
                    match (fast, slow) {
                        (Some(a), Some(b)) => {
                            assert!((a[0] - b[0]).abs() < 0.004 && (a[1] - b[1]).abs() < 0.004);
                        }
                        (a, b) => assert_eq!(a.is_some(), b.is_some(), "{a:?} {b:?}"),
                    }
                }
            }
        }
    }
}
