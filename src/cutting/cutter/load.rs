//! Force on the tool where it stands, edge by edge.

use super::Cutter;
use super::bite::{Bite, MOST_WAYS};
use crate::cutting::dexel::frame::Frame;
use crate::ground::spatial::{M3, V3, add, dot, norm, scale};
use std::f64::consts::TAU;

/// Force on the tool, and how it changes with the tool's place.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Load {
    /// N, workpiece frame.
    pub force: V3,
    /// ∂force/∂place, N/m, by rows.
    pub slope: M3,
}

/// Step of the slope over the chip, m.
const NUDGE: f64 = 1e-8;

impl Cutter {
    /// Force with tooth 1 at the angle `cells` (in steps of a revolution from φ = 0) at the tip, over one
    /// step around it. `ways[m]`: how far the tool moved while m + 1 teeth passed, workpiece frame, m.
    pub fn load(&self, cells: f64, ways: &[V3]) -> Load {
        let frame = self.engagement.frame;
        let inside = |v: &V3| [frame.x, frame.y, frame.z].map(|e| dot(*v, e));
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
                let met = self.engagement.met(i, turn - edge.lag_cells);
                if met.share > 0.0 {
                    let [ls, lc] = edge.lag;
                    let here = [sin * lc - cos * ls, cos * lc + sin * ls];
                    let bite = Bite {
                        direction: turned_by(here, step * met.middle),
                        normal: ring.disc.normal,
                        step: step * met.width,
                    };
                    let (mean, part) = bite.chip(ways, tooth, &edge.radii);
                    if part > 0.0 {
                        let length = met.share * part * ring.disc.edge_m;
                        self.add(&mut sum, &bite, mean / part, length);
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

#[derive(Default)]
struct Sum {
    force: V3,
    slope: M3,
}

/// Sine and cosine of an angle, a little further.
#[inline]
fn turned_by([sin, cos]: [f64; 2], angle: f64) -> [f64; 2] {
    if angle == 0.0 {
        return [sin, cos];
    }
    let (s, c) = angle.sin_cos();
    [sin * c + cos * s, cos * c - sin * s]
}

/// Force slopes of the frame in the workpiece frame: R S Rᵀ.
fn turned(slope: &M3, frame: &Frame) -> M3 {
    let columns = [0, 1, 2].map(|l| frame.out([slope[0][l], slope[1][l], slope[2][l]]));
    let axes = [frame.x, frame.y, frame.z];
    [0, 1, 2].map(|k| [0, 1, 2].map(|l| (0..3).map(|a| columns[a][k] * axes[a][l]).sum()))
}
