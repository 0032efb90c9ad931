//! Which share of the tool's envelope stands in material: entry and exit of every ring.
//!
//! The stock is looked at before the tool's latest way is taken from it: what the tool itself has cut
//! there is known exactly, as the places it stood at, and costs no accuracy by the rays' spacing. On
//! every cell of ring and angle the depth at its corners says which share of it is in.

use super::arc::{Arc, TOUCH, taken};
use super::cells::{column, inside, positive_mean};
use super::crossing::straightened;
use super::frame::Frame;
use super::heading::Heading;
use super::part::{Met, Part};
use super::rings::Ring;
use super::solid::Solid;
use super::stock::Stock;
use crate::ground::spatial::{V3, add, dot, scale, unit};
use std::f64::consts::TAU;

/// Shares of cells in material.
#[derive(Debug, Clone, PartialEq)]
pub struct Engagement {
    /// The frame of its angles.
    pub frame: Frame,
    angles: usize,
    rings: Vec<Ring>,
    directions: Vec<[f64; 2]>,
    heading: Heading,
    parts: Vec<Part>,
    /// Rings below this one may be in material.
    used: usize,
    nodes: Vec<f64>,
    /// Depths at the lower and upper end of every cell's border along the meridian, straight between them.
    columns: Vec<[f64; 2]>,
    /// Depth at which a wall is touched and not cut, m: what the places of an earlier way left standing between them.
    touched: f64,
    /// What the latest places take of the circle that is looked along.
    arcs: Vec<Arc>,
}

impl Engagement {
    /// Nothing in material yet: `angles` cells around each ring.
    pub fn new(rings: Vec<Ring>, angles: usize, frame: Frame) -> Self {
        let step = TAU / angles as f64;
        let direction = |k: usize| {
            let (sin, cos) = (step * k as f64).sin_cos();
            [sin, cos]
        };
        Self {
            frame,
            angles,
            parts: vec![Part::NONE; rings.len() * angles],
            nodes: vec![0.0; (rings.len() + 1) * angles],
            columns: vec![[0.0; 2]; rings.len() * angles],
            touched: TOUCH,
            directions: (0..angles).map(direction).collect(),
            heading: Heading::default(),
            rings,
            used: 0,
            arcs: Vec::new(),
        }
    }

    /// Cells around.
    pub fn angles(&self) -> usize {
        self.angles
    }

    /// Rings that may be in material, from the end upwards.
    pub fn rings(&self) -> &[Ring] {
        &self.rings[..self.used]
    }

    /// All rings.
    pub fn all_rings(&self) -> &[Ring] {
        &self.rings
    }

    /// What an edge of ring `i` meets about the angle `cells` (in cells from φ = 0), over a cell's width.
    #[inline]
    pub fn met(&self, i: usize, cells: f64) -> Met {
        let n = self.angles as f64;
        let x = (cells - 0.5).rem_euclid(n);
        let low = (x as usize).min(self.angles - 1);
        let high = if low + 1 == self.angles { 0 } else { low + 1 };
        let row = &self.parts[i * self.angles..(i + 1) * self.angles];
        Met::over(&row[low], &row[high], x - low as f64)
    }

    /// Highest ring with material, m above the tip.
    pub fn depth_m(&self) -> f64 {
        let row = |i: usize| &self.parts[i * self.angles..(i + 1) * self.angles];
        let last = (0..self.used)
            .rev()
            .find(|i| row(*i).iter().any(|p| p.share() > 0.0));
        last.map_or(0.0, |i| self.rings[i].circles[1][1])
    }

    /// Looks around: the tool at `tip` moving along `way`, as far as while one tooth passes, the stock as it was before the
    /// places `latest` were taken from it.
    pub fn look(&mut self, stock: &Stock, tip: V3, way: V3, latest: &[Solid]) {
        let top = stock.height_above(tip, self.frame.z);
        let below = |r: &&Ring| r.circles[0][1] < top;
        let used = self.rings.iter().take_while(below).count();
        let cleared = used.max(self.used) * self.angles;
        self.parts[..cleared].fill(Part::NONE);
        self.used = used;
        let widest = self.rings.iter().map(|r| r.circles[1][0]);
        let apart = APART * stock.spacing();
        self.touched = TOUCH + apart * apart / (8.0 * widest.fold(apart, f64::max));
        if used == 0 {
            return;
        }
        self.heading.turn(&self.frame, &self.directions, way);
        for line in 0..=used {
            self.sound(stock, tip, latest, line);
        }
        for i in 0..used {
            if self.heading.may_lead(&self.rings[i]) {
                let ground = Ground { stock, tip, latest };
                self.straighten(&ground, i);
                self.divide(&ground, i);
            }
        }
    }

    /// Depths around circle `line`.
    fn sound(&mut self, stock: &Stock, tip: V3, latest: &[Solid], line: usize) {
        let lower = line.saturating_sub(1);
        let ring = &self.rings[lower];
        let next = self.rings.get(line).unwrap_or(ring);
        let nodes = &mut self.nodes[line * self.angles..(line + 1) * self.angles];
        nodes.fill(GONE);
        if !self.heading.may_lead(ring) && !self.heading.may_lead(next) {
            return;
        }
        let [radius, height] = ring.circles[usize::from(line > 0)];
        let centre = add(tip, scale(height, self.frame.z));
        self.arcs.clear();
        let arcs = latest
            .iter()
            .map(|s| Arc::of(s, &self.frame, centre, radius));
        self.arcs.extend(arcs);
        for (k, node) in nodes.iter_mut().enumerate() {
            if self.heading.nears(ring, k) || self.heading.nears(next, k) {
                let point = add(centre, scale(radius, self.heading.outward(k)));
                if !taken(&self.arcs, latest, self.directions[k], point) {
                    *node = stock.depth(add(point, self.heading.halfway(k))) - self.touched;
                }
            }
        }
    }

    /// Depth at a share of the way from a meridian to the next and from the lower circle of a ring to its upper.
    fn depth_at(&self, ground: &Ground, ring: &Ring, k: usize, [around, up]: [f64; 2]) -> f64 {
        let [[r0, h0], [r1, h1]] = ring.circles;
        let next = if k + 1 == self.angles { 0 } else { k + 1 };
        let between = |a: V3, b: V3| add(scale(1.0 - around, a), scale(around, b));
        let [out, shift] = match around == 0.0 {
            true => [self.heading.outward(k), self.heading.halfway(k)],
            false => [
                unit(between(self.heading.outward(k), self.heading.outward(next)))
                    .unwrap_or_default(),
                between(self.heading.halfway(k), self.heading.halfway(next)),
            ],
        };
        let centre = add(ground.tip, scale(h0 + up * (h1 - h0), self.frame.z));
        let point = add(centre, scale(r0 + up * (r1 - r0), out));
        match ground.latest.iter().any(|s| s.holds(point, TOUCH)) {
            true => GONE,
            false => ground.stock.depth(add(point, shift)) - self.touched,
        }
    }

    /// Depths along the meridians of ring i, where it goes forward.
    fn straighten(&mut self, ground: &Ground, i: usize) {
        let n = self.angles;
        let ring = self.rings[i];
        for k in (0..n).filter(|k| self.heading.leads(&ring, *k)) {
            let ends = [self.nodes[i * n + k], self.nodes[(i + 1) * n + k]];
            self.columns[i * n + k] = match cross(ends) {
                true => straightened(ends, ring.length_m, |up| {
                    self.depth_at(ground, &ring, k, [0.0, up])
                }),
                false => ends,
            };
        }
    }

    /// Shares of the cells of ring i from the depths at their corners.
    fn divide(&mut self, ground: &Ground, i: usize) {
        let n = self.angles;
        let ring = self.rings[i];
        let mut leads = self.heading.leads(&ring, 0);
        for k in 0..n {
            let next = if k + 1 == n { 0 } else { k + 1 };
            let follows = self.heading.leads(&ring, next);
            let ends @ [[a, c], [b, d]] = [self.columns[i * n + k], self.columns[i * n + next]];
            let all = |share: f64| Part::even(share);
            self.parts[i * n + k] = match (leads, follows) {
                // behind the front there is nothing to cut, whatever the depths say
                (false, false) => Part::NONE,
                (true, false) => all(column(a, c)),
                (false, true) => all(column(b, d)),
                (true, true) if cross([a, c]) && cross([b, d]) && (a > 0.0) == (b > 0.0) => {
                    all(0.5 * (column(a, c) + column(b, d)))
                }
                (true, true) => self
                    .beside(ground, &ring, k, ends)
                    .unwrap_or_else(|| all(0.5 * (inside(a, b, c) + inside(d, c, b)))),
            };
            leads = follows;
        }
    }

    /// Share of a cell of which one meridian is in air from end to end and the other is not: as much of it as is in there, as far
    /// around as half way up that. Where the border is straight that is its triangle or trapeze; where a wall meets the surface
    /// it is their rectangle, of which the depths at the corners, distances to the nearer of both, tell nothing.
    fn beside(&self, ground: &Ground, ring: &Ring, k: usize, ends: [[f64; 2]; 2]) -> Option<Part> {
        let shares = ends.map(|[low, high]| column(low, high));
        let [here, there] = shares.map(|s| s > 0.0);
        if here == there {
            return None;
        }
        let (own, share) = if here {
            (ends[0], shares[0])
        } else {
            (ends[1], shares[1])
        };
        let up = match (own[0] > 0.0, own[1] > 0.0) {
            (true, true) => 0.5,
            (true, false) => 0.5 * share,
            _ => 1.0 - 0.5 * share,
        };
        let depths = [0.0, 1.0].map(|around| self.depth_at(ground, ring, k, [around, up]));
        if !cross(depths) {
            return None;
        }
        let length = ring.disc.radius_m * TAU / self.angles as f64;
        let [low, high] = straightened(depths, length, |around| {
            self.depth_at(ground, ring, k, [around, up])
        });
        Some(Part::beside(share, column(low, high), there))
    }

    /// Volume swept while the tool moves by `way` (m): the engaged envelope times its motion; and the part of it that the flat end sweeps,
    /// which has no edge.
    pub fn swept(&self, way: V3) -> [f64; 2] {
        let step = TAU / self.angles as f64;
        let mut sums = [0.0; 2];
        let along = |direction: &[f64; 2]| dot(way, self.frame.outward(*direction));
        let along: Vec<f64> = self.directions.iter().map(along).collect();
        let raised = dot(way, self.frame.z);
        for (i, ring) in self.rings().iter().enumerate() {
            let [sin, cos] = ring.disc.normal;
            let area = ring.length_m * ring.disc.radius_m * step;
            let lift = -cos * raised;
            let row = &self.parts[i * self.angles..(i + 1) * self.angles];
            for (k, part) in row.iter().enumerate().filter(|(_, p)| p.share() > 0.0) {
                let next = (k + 1) % self.angles;
                let (a, b) = (sin * along[k] + lift, sin * along[next] + lift);
                let ([from, to], height) = part.span();
                let chip = positive_mean(a + from * (b - a), a + to * (b - a));
                let more = 0.5 * (self.heading.second_order(k) + self.heading.second_order(next));
                let own = height * (to - from) * (area * chip + ring.disc.height_m * step * more);
                sums[0] += own;
                sums[1] += if ring.disc.edge_m == 0.0 { own } else { 0.0 };
            }
        }
        sums
    }
}

/// What the tool stands in.
struct Ground<'a> {
    stock: &'a Stock,
    tip: V3,
    /// Places that are not taken from the stock yet.
    latest: &'a [Solid],
}

/// Whether a border lies between two depths that both are known.
fn cross(ends: [f64; 2]) -> bool {
    (ends[0] > 0.0) != (ends[1] > 0.0) && ends.iter().all(|d| *d > GONE)
}

/// Distance of the places that stand for the tool's way, in spacings of the rays.
pub const APART: f64 = 0.5;
/// Depth of a place that is air whatever the stock says, m.
const GONE: f64 = -1.0;
