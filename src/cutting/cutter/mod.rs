//! The tool in its stock: what it takes away along its way, and the force on it, chip by chip.
//!
//! The chip of a tooth is its way since an earlier tooth stood at the same angle, along the outward
//! normal: the feed and the regenerative term in one (source 001, eq. 3), h = (u(t) − u(t − mτ))·n, the
//! least over the teeth before it, so that one that left the cut leaves its share to the next.
//! Along the ray that the tooth stands on, as the trochoids have it: `bite`. Runout makes teeth longer and shorter here; that it also
//! moves them aside, by its share of the radius, is in `wave` alone.

mod bite;
mod load;
mod motion;
#[cfg(test)]
mod tests;

pub use load::Load;

use super::dexel::engagement::Engagement;
use super::dexel::frame::Frame;
use super::dexel::{Solid, Stock, rings};
use super::law::Material;
use super::tool::Tool;
use crate::ground::spatial::{V3, norm, sub};
use std::collections::VecDeque;
use std::f64::consts::TAU;

/// How finely the cut is resolved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fineness {
    /// Distance of the rays of the stock, m.
    pub spacing_m: f64,
    /// Steps per revolution: a multiple of the teeth.
    pub steps: usize,
    /// How far the tool is told to go before it is looked again what it stands in, m; 0: at every passing of a tooth.
    pub patience_m: f64,
}

impl Fineness {
    /// 20 rays per radius and steps of three degrees, all teeth alike.
    pub fn usual(tool: &Tool) -> Self {
        Self {
            spacing_m: tool.radius_m / 20.0,
            steps: tool.teeth * 120_usize.div_ceil(tool.teeth),
            patience_m: 0.0,
        }
    }
}

/// A tool, its material and its stock.
#[derive(Debug, Clone)]
pub struct Cutter {
    tool: Tool,
    material: Material,
    fineness: Fineness,
    stock: Stock,
    engagement: Engagement,
    edges: Vec<Edge>,
    forward: V3,
    place: Option<(V3, V3)>,
    /// Where the tool was told to be when it was looked last, and where it went then.
    looked: Option<(V3, Option<V3>)>,
    /// Its way since then, m.
    unbooked: V3,
    latest: VecDeque<Solid>,
    /// The last place that is noted, or was beside the stock.
    mark: V3,
    removed: f64,
    drilled: f64,
    stood_in: f64,
}

/// What the teeth of one ring need in every step.
#[derive(Debug, Clone)]
struct Edge {
    lag: [f64; 2],
    lag_cells: f64,
    radii: Vec<f64>,
}

impl Cutter {
    /// A tool beside its stock. `forward` (workpiece frame) is where angles count from, usually the
    /// first feed; `axis` the spindle axis.
    pub fn new(
        tool: &Tool,
        material: &Material,
        stock: Stock,
        fineness: Fineness,
        axis: V3,
    ) -> Self {
        let forward = [1.0, 0.0, 0.0];
        let frame = Frame::towards(forward, axis);
        let (low, high) = stock.bounds();
        let height = norm(sub(high, low)).min(tool.flute_m);
        let rings = rings(tool, fineness.spacing_m, height.max(tool.corner_radius_m));
        let step = TAU / fineness.steps as f64;
        let edge = |ring: &super::dexel::rings::Ring| {
            let (sin, cos) = ring.disc.lag_rad.sin_cos();
            Edge {
                lag: [sin, cos],
                lag_cells: ring.disc.lag_rad / step,
                radii: (0..tool.teeth)
                    .map(|j| tool.tooth_radius(&ring.disc, j))
                    .collect(),
            }
        };
        Self {
            edges: rings.iter().map(edge).collect(),
            engagement: Engagement::new(rings, fineness.steps, frame),
            tool: tool.clone(),
            material: material.clone(),
            fineness,
            stock,
            forward,
            place: None,
            looked: None,
            unbooked: [0.0; 3],
            latest: VecDeque::new(),
            mark: [0.0; 3],
            removed: 0.0,
            drilled: 0.0,
            stood_in: 0.0,
        }
    }

    /// Volume taken so far, m³: the engaged envelope times its motion.
    pub fn removed(&self) -> f64 {
        self.removed
    }

    /// The part of it that the flat end took, m³: it has no edge, and no law says with what force it drills.
    pub fn drilled(&self) -> f64 {
        self.drilled
    }

    /// Volume of stock where the tool stood when it was put into place first, m³: nobody cut it, and it is gone.
    pub fn stood_in(&self) -> f64 {
        self.stood_in
    }

    /// What is left, once [`Cutter::settle`] was called.
    pub fn stock(&self) -> &Stock {
        &self.stock
    }

    /// What stands in material.
    pub fn engagement(&self) -> &Engagement {
        &self.engagement
    }

    /// The tool.
    pub fn tool(&self) -> &Tool {
        &self.tool
    }

    /// Steps per revolution.
    pub fn steps(&self) -> usize {
        self.fineness.steps
    }

    /// Whether the tool at a place is near enough to the stock that it may cut within `margin` m.
    pub fn near(&self, tip: V3, axis: V3, margin: f64) -> bool {
        self.stock.meets(&self.solid(tip, axis), margin)
    }

    fn solid(&self, tip: V3, axis: V3) -> Solid {
        Solid::of(&self.tool, self.tool.flute_m.min(10.0), tip, axis)
    }
}
