//! Wave forms of the cutting force over a revolution of a steady cut.
//!
//! Both families of sums that the linear law needs are gathered once: forces for any coefficients, and
//! their derivatives, are then products.

use super::chip::{Steady, Stock, Tip, turned};
use super::law::Direction;
use super::tool::{Disc, FINE, Tool};
use crate::ground::dual::Scalar;
use crate::ground::spatial::V3;
use std::f64::consts::TAU;

/// Side on which a cut meets its stock.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// Full slot: the width plays no part.
    Slot,
    /// Teeth enter at φ = 0.
    Up,
    /// Teeth leave at φ = 180°.
    Down,
}

/// A steady straight cut.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cut {
    /// Speed of the spindle, rad/s.
    pub spindle_rad_s: f64,
    /// Feed of the tool, m/s.
    pub feed_m_s: f64,
    /// Depth along the axis, m.
    pub depth_m: f64,
    /// Width across the feed, m.
    pub width_m: f64,
    /// Where the stock is.
    pub side: Side,
}

impl Cut {
    /// Feed per tooth, m.
    pub fn feed_per_tooth(&self, teeth: usize) -> f64 {
        self.feed_per_radian() * TAU / teeth as f64
    }

    /// Feed per radian of the spindle, m/rad.
    pub fn feed_per_radian(&self) -> f64 {
        self.feed_m_s / self.spindle_rad_s
    }

    /// Where the stock is for a tool of this radius, with the width as a scalar of its own.
    pub fn stock<S: Scalar>(&self, radius_m: f64, width: S) -> Stock<S> {
        let border = S::constant(radius_m) - width;
        match self.side {
            Side::Slot => Stock::Full,
            Side::Up => Stock::Left(border),
            Side::Down => Stock::Right(-border),
        }
    }
}

/// Sums over all edges in cut: what each coefficient of the linear law is multiplied with.
/// Order: Ktc, Krc, Kac, Kte, Kre, Kae; m² for the first three, m for the others.
pub type Basis<S> = [[S; 3]; 6];

/// A cut whose runout and width may carry derivatives.
#[derive(Debug, Clone)]
pub struct Wave<'a, S: Scalar> {
    /// The tool.
    pub tool: &'a Tool,
    /// Its discs in the cut.
    pub discs: Vec<Disc>,
    /// Tips of all teeth, disc by disc.
    tips: Vec<Vec<Tip<S>>>,
    /// Sine and cosine of the angles by which they stand ahead of tooth 1 at the tip.
    pub(super) lags: Vec<Vec<[f64; 2]>>,
    steady: Steady<S>,
}

impl<'a, S: Scalar> Wave<'a, S> {
    /// A cut by a tool whose runout (parts along tooth 1 and a quarter turn on, m) and width (m) are
    /// given apart from what the tool and the cut say.
    pub fn new(tool: &'a Tool, cut: &Cut, runout: [S; 2], width: S) -> Self {
        Self::sliced((tool, FINE), cut, runout, width)
    }

    /// The same by discs along each of which the edge lags by so much (rad) at most.
    pub fn sliced((tool, fine): (&'a Tool, f64), cut: &Cut, runout: [S; 2], width: S) -> Self {
        let discs = tool.discs_of(cut.depth_m, fine);
        let all = |disc: &Disc| (0..tool.teeth).map(|j| tool.tip(disc, j, runout)).collect();
        let ahead = |disc: &Disc, j: usize| {
            let (sin, cos) = tool.tooth_angle(0.0, j, disc).sin_cos();
            [sin, cos]
        };
        let lags = |disc: &Disc| (0..tool.teeth).map(|j| ahead(disc, j)).collect();
        Self {
            tool,
            tips: discs.iter().map(all).collect(),
            lags: discs.iter().map(lags).collect(),
            discs,
            steady: Steady {
                feed_per_radian: cut.feed_per_radian(),
                stock: cut.stock(tool.radius_m, width),
                before: S::constant(0.0),
            },
        }
    }

    /// The same where this share of a ray before the border of the stock counts as chip.
    #[must_use]
    pub fn before_the_border(mut self, share: S) -> Self {
        self.steady.before = share;
        self
    }

    /// The same with teeth shorter by these lengths (m; none given: unchanged) from the tip to a height (m).
    #[must_use]
    pub fn shorter(mut self, by: &[f64], height_m: f64) -> Self {
        for (disc, tips) in self.discs.iter().zip(&mut self.tips) {
            for (tip, by) in tips.iter_mut().zip(by).filter(|_| disc.z_m < height_m) {
                tip.radius += S::constant(-by);
            }
        }
        self
    }

    /// The sums when tooth 1 stands at `spindle` (rad) at the tip. `blur` (rad) is the least angle over
    /// which an entry or exit is spread: the distance of the samples if the wave is to be filtered.
    pub fn basis(&self, spindle: S, blur: f64) -> Basis<S> {
        self.basis_of(spindle, blur, |chip| chip)
    }

    /// The same where the first three sums are of some function of the chip's thickness (m), above zero, in its place.
    pub fn basis_of(&self, spindle: S, blur: f64, chip: impl Fn(S) -> S) -> Basis<S> {
        let mut sums = [[S::constant(0.0); 3]; 6];
        let [sin, cos] = spindle.sin_cos();
        let plain = [sin.value(), cos.value()];
        for ((disc, tips), lags) in self.discs.iter().zip(&self.tips).zip(&self.lags) {
            let lag = disc.lag_width_rad;
            let reach = 0.5 * (lag.max(SHARP) + blur);
            for (tooth, [s, c]) in lags.iter().enumerate() {
                let near = [plain[0] * c + plain[1] * s, plain[1] * c - plain[0] * s];
                if near[0] < OUTSIDE || self.steady.ahead(near, &tips[tooth]) <= -reach {
                    continue;
                }
                let direction = [sin * *c + cos * *s, cos * *c - sin * *s];
                self.add(&mut sums, (disc, tooth, tips), direction, blur, &chip);
            }
        }
        sums
    }

    /// Whether a tooth cuts in a disc, at its tooth angle as sine and cosine.
    pub(super) fn cuts(&self, disc: usize, tooth: usize, direction: [S; 2]) -> bool {
        let tips = &self.tips[disc];
        let near = direction.map(Scalar::value);
        near[0] > OUTSIDE
            && self.steady.ahead(near, &tips[tooth]) > 0.0
            && self.steady.bite(direction, tooth, tips).depth_rad.value() > 0.0
    }

    fn add(
        &self,
        sums: &mut Basis<S>,
        (disc, tooth, tips): (&Disc, usize, &[Tip<S>]),
        mut direction: [S; 2],
        blur: f64,
        chip: &impl Fn(S) -> S,
    ) {
        let mut bite = self.steady.bite(direction, tooth, tips);
        let lag = disc.lag_width_rad;
        let share = passed(bite.depth_rad, lag.max(SHARP), blur);
        if share.value() <= 0.0 {
            return;
        }
        if share.value() < 1.0 && lag > 0.0 {
            // the middle of that part of the edge that is in
            let further = (-share + 1.0) * (0.5 * lag * bite.side);
            direction = turned(direction, further);
            bite = self.steady.bite(direction, tooth, tips);
        }
        let length = share * disc.edge_m;
        let area = chip(bite.thickness.max(S::constant(0.0))) * disc.normal[0] * length;
        // the tip moves about the spindle's axis, and its force is along that motion
        let along = Direction {
            tooth: turned(direction, tips[tooth].aside),
            normal: disc.normal,
        };
        for (k, axis) in along.axes().iter().enumerate() {
            for (i, part) in axis.iter().enumerate() {
                sums[k][i] += *part * area;
                sums[k + 3][i] += *part * length;
            }
        }
    }
}

/// Share of an edge that has passed a border by `depth` when it is spread evenly over one width, and
/// that over another.
fn passed<S: Scalar>(depth: S, one: f64, other: f64) -> S {
    let (wide, narrow) = (one.max(other), one.min(other));
    let away = 0.5 * (wide + narrow) - depth.value().abs();
    if away <= 0.0 {
        return S::constant(if depth.value() > 0.0 { 1.0 } else { 0.0 });
    }
    if away >= narrow {
        return depth / wide + 0.5;
    }
    let positive = depth.value() > 0.0;
    let left = if positive { -depth } else { depth } + 0.5 * (wide + narrow);
    let rest = left * left / (2.0 * wide * narrow);
    if positive { -rest + 1.0 } else { rest }
}

/// sin φ below which no tooth of a sensible feed cuts: behind the tool.
const OUTSIDE: f64 = -0.2;
/// An edge that enters at once, rad.
const SHARP: f64 = 1e-9;

/// The force of the linear law from its sums: coefficients in SI, N.
pub fn force<S: Scalar>(basis: &Basis<S>, coefficients: &[f64]) -> [S; 3] {
    let mut force = [S::constant(0.0); 3];
    for (sums, k) in basis.iter().zip(coefficients) {
        for i in 0..3 {
            force[i] += sums[i] * *k;
        }
    }
    force
}

/// The mean of the linear law's sums over a revolution.
pub fn mean_basis(tool: &Tool, cut: &Cut, steps: usize) -> Basis<f64> {
    let (sin, cos) = tool.runout_angle_rad.sin_cos();
    let runout = [tool.runout_m * cos, tool.runout_m * sin];
    let wave = Wave::new(tool, cut, runout, cut.width_m);
    let step = TAU / steps as f64;
    let mut mean = [[0.0; 3]; 6];
    for i in 0..steps {
        let basis = wave.basis(i as f64 * step, step);
        for (m, b) in mean.iter_mut().flatten().zip(basis.iter().flatten()) {
            *m += b / steps as f64;
        }
    }
    mean
}

/// Mean force over a revolution, N.
pub fn mean_force(tool: &Tool, cut: &Cut, coefficients: &[f64]) -> V3 {
    force(&mean_basis(tool, cut, 3600), coefficients)
}

#[cfg(test)]
mod tests;
