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
use super::rings::Ring;
use super::solid::Solid;
use super::stock::Stock;
use crate::ground::spatial::{V3, add, dot, scale};
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
    share: Vec<f64>,
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
            share: vec![0.0; rings.len() * angles],
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

    /// Share of ring `i` in material about the angle `cells` (in cells from φ = 0), between cells
    /// linear.
    #[inline]
    pub fn share(&self, i: usize, cells: f64) -> f64 {
        let n = self.angles as f64;
        let x = (cells - 0.5).rem_euclid(n);
        let low = (x as usize).min(self.angles - 1);
        let high = if low + 1 == self.angles { 0 } else { low + 1 };
        let part = x - low as f64;
        let row = &self.share[i * self.angles..(i + 1) * self.angles];
        row[low] + part * (row[high] - row[low])
    }

    /// Highest ring with material, m above the tip.
    pub fn depth_m(&self) -> f64 {
        let row = |i: usize| &self.share[i * self.angles..(i + 1) * self.angles];
        let last = (0..self.used)
            .rev()
            .find(|i| row(*i).iter().any(|s| *s > 0.0));
        last.map_or(0.0, |i| self.rings[i].circles[1][1])
    }

    /// Looks around: the tool at `tip` moving along `way` (any length), the stock as it was before the
    /// places `latest` were taken from it.
    pub fn look(&mut self, stock: &Stock, tip: V3, way: V3, latest: &[Solid]) {
        let top = stock.height_above(tip, self.frame.z);
        let below = |r: &&Ring| r.circles[0][1] < top;
        let used = self.rings.iter().take_while(below).count();
        let cleared = used.max(self.used) * self.angles;
        self.share[..cleared].fill(0.0);
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
                self.straighten(stock, tip, latest, i);
                self.divide(i);
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
                    *node = stock.depth(point) - self.touched;
                }
            }
        }
    }

    /// Depths along the meridians of ring i, where it goes forward.
    fn straighten(&mut self, stock: &Stock, tip: V3, latest: &[Solid], i: usize) {
        let n = self.angles;
        let ring = &self.rings[i];
        let [[r0, h0], [r1, h1]] = ring.circles;
        for k in (0..n).filter(|k| self.heading.leads(ring, *k)) {
            let ends = [self.nodes[i * n + k], self.nodes[(i + 1) * n + k]];
            let crosses = (ends[0] > 0.0) != (ends[1] > 0.0);
            let at = |t: f64| {
                let centre = add(tip, scale(h0 + t * (h1 - h0), self.frame.z));
                let point = add(centre, scale(r0 + t * (r1 - r0), self.heading.outward(k)));
                match latest.iter().any(|s| s.holds(point, TOUCH)) {
                    true => GONE,
                    false => stock.depth(point) - self.touched,
                }
            };
            self.columns[i * n + k] = match crosses && ends.iter().all(|d| *d > GONE) {
                true => straightened(ends, ring.length_m, at),
                false => ends,
            };
        }
    }

    /// Shares of the cells of ring i from the depths at their corners.
    fn divide(&mut self, i: usize) {
        let n = self.angles;
        let ring = &self.rings[i];
        let columns = &self.columns[i * n..(i + 1) * n];
        let shares = &mut self.share[i * n..(i + 1) * n];
        let mut leads = self.heading.leads(ring, 0);
        for (k, share) in shares.iter_mut().enumerate() {
            let next = if k + 1 == n { 0 } else { k + 1 };
            let follows = self.heading.leads(ring, next);
            let [[a, c], [b, d]] = [columns[k], columns[next]];
            *share = match (leads, follows) {
                // behind the front there is nothing to cut, whatever the depths say
                (false, false) => 0.0,
                (true, false) => column(a, c),
                (false, true) => column(b, d),
                (true, true) => 0.5 * (inside(a, b, c) + inside(d, c, b)),
            };
            leads = follows;
        }
    }

    /// Volume swept while the tool moves by `way` (m): the engaged envelope times its motion.
    pub fn swept(&self, way: V3) -> f64 {
        let step = TAU / self.angles as f64;
        let mut sum = 0.0;
        for (i, ring) in self.rings().iter().enumerate() {
            let [sin, cos] = ring.disc.normal;
            let area = ring.length_m * ring.disc.radius_m * step;
            let lift = -cos * dot(way, self.frame.z);
            for (k, share) in self.share[i * self.angles..(i + 1) * self.angles]
                .iter()
                .enumerate()
            {
                if *share > 0.0 {
                    let next = (k + 1) % self.angles;
                    let [a, b] = [k, next]
                        .map(|k| sin * dot(way, self.frame.outward(self.directions[k])) + lift);
                    sum += share * area * positive_mean(a, b);
                }
            }
        }
        sum
    }
}

/// Distance of the places that stand for the tool's way, in spacings of the rays.
pub const APART: f64 = 0.5;
/// Depth of a place that is air whatever the stock says, m.
const GONE: f64 = -1.0;
