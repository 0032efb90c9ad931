//! The tool in its stock: what it takes away along its way, and the force on it, chip by chip.
//!
//! The chip of a tooth is its way since an earlier tooth stood at the same angle, along the outward
//! normal: the feed and the regenerative term in one (source 001, eq. 3), h = (u(t) − u(t − mτ))·n, the
//! least over the teeth before it, so that one that left the cut leaves its share to the next.

use super::dexel::engagement::{Engagement, Frame, positive_mean};
use super::dexel::{Solid, Stock, rings};
use super::law::Material;
use super::tool::Tool;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::{M3, V3, add, norm, scale, sub, unit};
use std::collections::VecDeque;
use std::f64::consts::TAU;

/// How finely the cut is resolved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fineness {
    /// Distance of the rays of the stock, m.
    pub spacing_m: f64,
    /// Steps per revolution: a multiple of the teeth.
    pub steps: usize,
}

impl Fineness {
    /// 20 rays per radius and steps of three degrees, all teeth alike.
    pub fn usual(tool: &Tool) -> Self {
        Self {
            spacing_m: tool.radius_m / 20.0,
            steps: tool.teeth * 120_usize.div_ceil(tool.teeth),
        }
    }
}

/// Force on the tool, and how it changes with the tool's place.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Load {
    /// N, workpiece frame.
    pub force: V3,
    /// ∂force/∂place, N/m, by rows.
    pub slope: M3,
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
    latest: VecDeque<Solid>,
    /// The last place that is noted, or was beside the stock.
    mark: V3,
    removed: f64,
}

/// What the teeth of one ring need in every step.
#[derive(Debug, Clone)]
struct Edge {
    lag: [f64; 2],
    lag_cells: f64,
    radii: Vec<f64>,
}

/// The latest way, as a share of the radius, that is known as places instead of being taken from the
/// rays: its end lies two spacings within the front.
const LATEST: f64 = 0.6;
/// Places of the latest way, in spacings.
const APART: f64 = 0.5;

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
            latest: VecDeque::new(),
            mark: [0.0; 3],
            removed: 0.0,
        }
    }

    /// Volume taken so far, m³: the engaged envelope times its motion.
    pub fn removed(&self) -> f64 {
        self.removed
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

    /// Moves the tool to `tip` with its axis along `axis`, in a straight line from where it was, takes
    /// what it meets, and looks what it stands in there.
    ///
    /// # Errors
    /// Material above the flutes.
    pub fn advance(&mut self, tip: V3, axis: V3) -> Outcome<()> {
        if self.place.is_none() {
            self.mark = tip;
        }
        let (from, _) = self.place.unwrap_or((tip, axis));
        self.place = Some((tip, axis));
        let way = sub(tip, from);
        if turned_from(axis, self.engagement.frame.z) {
            self.engagement.frame = Frame::towards(self.forward, axis);
        }
        let axis = self.engagement.frame.z;
        // in the middle of the way the engagement is its mean, to second order
        let middle = add(from, scale(0.5, way));
        let curved = self.curved(middle, way);
        self.engagement.look(&self.stock, middle, way, &curved);
        self.removed += self.engagement.swept(way);
        self.leave(from, tip, axis);
        self.check_flutes()
    }

    /// Puts the tool somewhere else without cutting on the way.
    pub fn jump(&mut self, tip: V3, axis: V3) {
        self.settle();
        self.place = Some((tip, axis));
        self.mark = tip;
    }

    /// Latest places that a straight motion does not leave behind by itself.
    fn curved(&self, tip: V3, way: V3) -> Vec<Solid> {
        const ALIGNED: f64 = 1e-10;
        let ahead = unit(way);
        let aside = |solid: &&Solid| {
            let from = unit(sub(tip, solid.tip));
            let turned = turned_from(solid.axis, self.engagement.frame.z);
            match (ahead, from) {
                (Some(a), Some(f)) => turned || norm(sub(a, f)) > ALIGNED.sqrt(),
                _ => turned,
            }
        };
        self.latest.iter().filter(aside).copied().collect()
    }

    /// Notes the places between two and takes the old ones from the stock.
    fn leave(&mut self, from: V3, tip: V3, axis: V3) {
        let way = sub(tip, self.mark);
        let count = (norm(way) / (APART * self.fineness.spacing_m)) as usize;
        let first = usize::from(self.latest.is_empty() && from == tip);
        let mark = self.mark;
        for i in 1..=count.max(first) {
            let place = add(mark, scale(i as f64 / count.max(1) as f64, way));
            if self.near(place, axis, 0.0) {
                let solid = self.solid(place, axis);
                self.latest.push_back(solid);
            }
            self.mark = place;
        }
        let keep = LATEST * self.tool.radius_m;
        while let Some(oldest) = self.latest.front().copied() {
            if norm(sub(tip, oldest.tip)) < keep && self.latest.len() < 1000 {
                break;
            }
            self.stock.remove(&oldest);
            self.latest.pop_front();
        }
    }

    /// Takes all that is still noted as latest way.
    pub fn settle(&mut self) {
        for solid in std::mem::take(&mut self.latest) {
            self.stock.remove(&solid);
        }
    }

    fn check_flutes(&self) -> Outcome<()> {
        let rings = self.engagement.rings();
        let all = rings.len() == self.engagement.all_rings().len();
        if !all || self.engagement.depth_m() < self.tool.flute_m * (1.0 - 1e-9) {
            return Ok(());
        }
        Err(Problem::new(
            format!(
                "the tool cuts deeper than its flutes, {:.1} mm",
                1e3 * self.tool.flute_m
            ),
            "cut in several depths, or give a longer `flute_mm`",
        ))
    }

    /// Force with tooth 1 at the angle `cells` (in steps of a revolution from φ = 0) at the tip, over one
    /// step around it. `ways[m]`: how far the tool moved while m + 1 teeth passed, workpiece frame, m.
    pub fn load(&self, cells: f64, ways: &[V3]) -> Load {
        let frame = self.engagement.frame;
        let inside =
            |v: &V3| [frame.x, frame.y, frame.z].map(|e| crate::ground::spatial::dot(*v, e));
        let mut ways: [V3; MOST_WAYS] =
            std::array::from_fn(|m| ways.get(m).map_or([f64::NAN; 3], inside));
        let known = ways.iter().take_while(|w| !w[0].is_nan()).count();
        ways.reverse();
        let ways = &ways[MOST_WAYS - known..];
        let mut sum = Sum::default();
        let step = TAU / self.fineness.steps as f64;
        for tooth in 0..self.tool.teeth {
            let turn = cells + (tooth * self.fineness.steps) as f64 / self.tool.teeth as f64;
            let (sin, cos) = (step * turn).sin_cos();
            for (i, (ring, edge)) in self.engagement.rings().iter().zip(&self.edges).enumerate() {
                if ring.disc.edge_m == 0.0 {
                    continue;
                }
                let share = self.engagement.share(i, turn - edge.lag_cells);
                if share > 0.0 {
                    let [ls, lc] = edge.lag;
                    let direction = [sin * lc - cos * ls, cos * lc + sin * ls];
                    let bite = Bite {
                        direction,
                        normal: ring.disc.normal,
                        step,
                    };
                    let (mean, part) = bite.chip(ways, tooth, &edge.radii);
                    if part > 0.0 {
                        self.add(
                            &mut sum,
                            &bite,
                            mean / part,
                            share * part * ring.disc.edge_m,
                        );
                    }
                }
            }
        }
        Load {
            force: frame.out(sum.force),
            slope: turned(&sum.slope, &frame),
        }
    }

    fn add(&self, sum: &mut Sum, bite: &Bite, chip: f64, length: f64) {
        let law = |h: f64| self.material.law.per_length(&self.material.coefficients, h);
        let (here, more) = (law(chip), law(chip + NUDGE));
        let turn = bite.turn();
        let rise = turn.force([0, 1, 2].map(|a| (more[a] - here[a]) / NUDGE));
        sum.force = add(sum.force, scale(length, turn.force(here)));
        let normal = bite.outward();
        for (row, rise) in sum.slope.iter_mut().zip(rise) {
            *row = add(*row, scale(length * rise, normal));
        }
    }

    /// Mean force over a revolution of steady motion, `per_tooth` (m) while one tooth passes.
    pub fn mean_load(&self, per_tooth: V3) -> Load {
        self.revolution(per_tooth).0
    }

    /// The same, and the largest force within the revolution, N.
    pub fn revolution(&self, per_tooth: V3) -> (Load, f64) {
        let ways: Vec<V3> = (1..=self.memory())
            .map(|m| scale(m as f64, per_tooth))
            .collect();
        let steps = self.fineness.steps;
        // without runout all teeth are alike: one pitch says it all
        let steps = if self.tool.runout_m == 0.0 {
            steps / self.tool.teeth
        } else {
            steps
        };
        let (mut mean, mut peak) = (Load::default(), 0.0_f64);
        for q in 0..steps {
            let load = self.load(q as f64 + 0.5, &ways);
            peak = peak.max(norm(load.force));
            for k in 0..3 {
                mean.force[k] += load.force[k] / steps as f64;
                for l in 0..3 {
                    mean.slope[k][l] += load.slope[k][l] / steps as f64;
                }
            }
        }
        (mean, peak)
    }

    /// How many teeth back the chip remembers.
    pub fn memory(&self) -> usize {
        MOST_WAYS
    }
}

/// Teeth back that may have left the surface.
const MOST_WAYS: usize = 3;
/// Step of the slope over the chip, m.
const NUDGE: f64 = 1e-8;

/// Whether an axis differs from another by more than rounding.
fn turned_from(axis: V3, other: V3) -> bool {
    norm(sub(axis, other)) > 1e-9
}

#[derive(Default)]
struct Sum {
    force: V3,
    slope: M3,
}

/// Force slopes of the frame in the workpiece frame: R S Rᵀ.
fn turned(slope: &M3, frame: &Frame) -> M3 {
    let columns = [0, 1, 2].map(|l| frame.out([slope[0][l], slope[1][l], slope[2][l]]));
    let axes = [frame.x, frame.y, frame.z];
    [0, 1, 2].map(|k| [0, 1, 2].map(|l| (0..3).map(|a| columns[a][k] * axes[a][l]).sum()))
}

/// An edge at one angle, over one step.
struct Bite {
    direction: [f64; 2],
    normal: [f64; 2],
    step: f64,
}

impl Bite {
    fn outward(&self) -> V3 {
        let ([sin, cos], [sk, ck]) = (self.direction, self.normal);
        [sin * sk, cos * sk, -ck]
    }

    fn turn(&self) -> super::law::Direction {
        super::law::Direction {
            tooth: self.direction,
            normal: self.normal,
        }
    }

    /// Mean of the chip over the step, m, and the part of the step in which there is one. `ways` with the
    /// longest memory first.
    fn chip(&self, ways: &[V3], tooth: usize, radii: &[f64]) -> (f64, f64) {
        let [sin, cos] = self.direction;
        let normal = self.outward();
        let teeth = radii.len();
        let mut least = (f64::INFINITY, 0.0);
        for (i, way) in ways.iter().enumerate() {
            let back = ways.len() - i;
            let chip = crate::ground::spatial::dot(*way, normal) + radii[tooth]
                - radii[(tooth + back) % teeth];
            if chip < least.0 {
                let change = self.normal[0] * (way[0] * cos - way[1] * sin);
                least = (chip, 0.5 * self.step * change);
            }
        }
        let (low, high) = (least.0 - least.1, least.0 + least.1);
        let part = match (low > 0.0, high > 0.0) {
            (true, true) => 1.0,
            (false, false) => 0.0,
            _ => low.max(high) / (low - high).abs(),
        };
        (positive_mean(low, high), part)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_6, PI};

    const MM: f64 = 1e-3;
    const UP: V3 = [0.0, 0.0, 1.0];

    fn cutter(tool: &Tool, width: f64, spacing: f64) -> Cutter {
        // material beside the line y = 0 that the tool follows: y from -width-R.. as the cut needs
        let al7075 = Material::linear_edge([1319.41, 788.83, 48.75, 19.65, 26.77, 2.05]);
        let stock = Stock::block(
            [0.0, -20.0 * MM, -10.0 * MM],
            [60.0 * MM, width, 0.0],
            spacing,
        );
        let fineness = Fineness {
            spacing_m: spacing,
            ..Fineness::usual(tool)
        };
        Cutter::new(tool, &al7075, stock.unwrap(), fineness, UP)
    }

    fn go(cutter: &mut Cutter, from: V3, to: V3, step: f64) {
        let way = sub(to, from);
        let count = (norm(way) / step).ceil() as usize;
        for i in 0..=count {
            let at = add(from, scale(i as f64 / count as f64, way));
            cutter.advance(at, UP).unwrap();
        }
    }

    fn near(force: V3, expected: V3, share: f64) {
        let size = norm(expected);
        for k in 0..3 {
            assert!(
                (force[k] - expected[k]).abs() < share * size,
                "{force:?} {expected:?}"
            );
        }
    }

    #[test]
    fn mean_forces_are_those_of_the_closed_form() {
        // Altintas, N = 2, a = 2 mm, c = 0.1 mm: slot, half-up, half-down
        let cases = [
            (20.0 * MM, [-112.9676, 156.9602, 10.3070]),
            (0.0, [-1.9761, 120.6316, 5.1535]),
        ];
        for helix in [0.0, FRAC_PI_6] {
            for (width, expected) in cases {
                for spacing in [0.4 * MM, 0.37 * MM] {
                    let tool = Tool::square(8.0 * MM, 2, helix);
                    let mut cutter = cutter(&tool, width, spacing);
                    go(
                        &mut cutter,
                        [-9.0 * MM, 0.0, -2.0 * MM],
                        [30.0 * MM, 0.0, -2.0 * MM],
                        0.1 * MM,
                    );
                    let load = cutter.mean_load([0.1 * MM, 0.0, 0.0]);
                    near(load.force, expected, 0.005);
                }
            }
        }
    }

    #[test]
    fn removed_volumes_are_those_of_the_closed_form() {
        let tool = Tool::square(8.0 * MM, 2, 0.0);
        let mut slot = cutter(&tool, 20.0 * MM, 0.4 * MM);
        go(
            &mut slot,
            [-20.0 * MM, 0.0, -2.0 * MM],
            [30.0 * MM, 0.0, -2.0 * MM],
            0.1 * MM,
        );
        let end = 0.5 * PI * 64.0;
        let exact = (30.0 * 16.0 + end) * 2.0;
        assert!(
            (slot.removed() * 1e9 / exact - 1.0).abs() < 2e-3,
            "{} {exact}",
            slot.removed() * 1e9
        );
        // a second pass half beside the first: only the new half
        let before = slot.removed();
        go(
            &mut slot,
            [30.0 * MM, 0.0, 5.0 * MM],
            [70.0 * MM, 30.0 * MM, 5.0 * MM],
            1.0 * MM,
        );
        go(
            &mut slot,
            [70.0 * MM, -6.3 * MM, 5.0 * MM],
            [70.0 * MM, -6.3 * MM, -2.0 * MM],
            0.5 * MM,
        );
        go(
            &mut slot,
            [70.0 * MM, -6.3 * MM, -2.0 * MM],
            [-10.0 * MM, -6.3 * MM, -2.0 * MM],
            0.1 * MM,
        );
        // beyond the first slot's end the whole width, before it 6.3 mm
        let n = 400_000;
        let area: f64 = (0..n)
            .map(|i| {
                let y = -14.3 + 16.0 * (i as f64 + 0.5) / n as f64;
                let slot = if y > -8.0 && y < 8.0 {
                    30.0 + (64.0 - y * y).max(0.0).sqrt()
                } else {
                    0.0
                };
                (60.0 - slot) * 16.0 / n as f64
            })
            .sum();
        let exact = 2.0 * area;
        let got = (slot.removed() - before) * 1e9;
        assert!((got / exact - 1.0).abs() < 2e-3, "{got} {exact}");
    }

    #[test]
    fn ramps_and_arcs_have_their_volume() {
        let tool = Tool::square(5.0 * MM, 2, 0.0);
        let mut ramp = cutter(&tool, 20.0 * MM, 0.25 * MM);
        go(
            &mut ramp,
            [20.0 * MM, 0.0, 0.0],
            [50.0 * MM, 0.0, -3.0 * MM],
            0.1 * MM,
        );
        // mean depth of a ramp's slot: its bottom is level under the tool, so the deepest counts
        let n = 400_000;
        let depth = |x: f64, y: f64| {
            let half = (25.0 - y * y).max(0.0).sqrt();
            let reach = (x + half).min(50.0);
            if reach < 20.0 || x - half > 50.0 {
                0.0
            } else {
                ((reach - 20.0) / 10.0).max(0.0)
            }
        };
        let (mut sum, rows) = (0.0, 400);
        for j in 0..rows {
            let y = -5.0 + 10.0 * (j as f64 + 0.5) / rows as f64;
            for i in 0..n / rows {
                let x = 15.0 + 40.0 * (i as f64 + 0.5) / (n / rows) as f64;
                let half = (25.0 - y * y).max(0.0).sqrt();
                if x > 20.0 - half && x < 50.0 + half {
                    sum += depth(x, y) * 400.0 / n as f64;
                }
            }
        }
        let got = ramp.removed() * 1e9;
        assert!((got / sum - 1.0).abs() < 2e-3, "{got} {sum}");
        let mut arc = cutter(&tool, 20.0 * MM, 0.25 * MM);
        let at = |a: f64| {
            [
                30.0 * MM + 12.0 * MM * a.sin(),
                -12.0 * MM * a.cos(),
                -2.0 * MM,
            ]
        };
        for i in 0..=400 {
            let before = at(PI * f64::from(i) / 400.0);
            arc.advance(before, UP).unwrap();
        }
        // the plunge at the first place is not swept: half a disc of the front, then the ring
        let ring = 0.5 * PI * (17.0 * 17.0 - 7.0 * 7.0) * 2.0;
        let got = arc.removed() * 1e9;
        assert!((got / ring - 1.0).abs() < 2e-3, "{got} {ring}");
    }
}
