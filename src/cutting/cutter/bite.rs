//! The chip of one edge: what it finds along its ray between the surface that the teeth before it left on
//! their trochoids and itself. The tool may have gone any way meanwhile; within the way of one tooth its
//! motion counts as straight, as in [`crate::cutting::chip`], which is the steady cut of the same geometry.

use crate::cutting::dexel::cells::positive_mean;
use crate::cutting::law::Direction;
use crate::ground::spatial::{V3, dot};
use std::f64::consts::TAU;

/// An edge at one angle, over one step.
pub(super) struct Bite {
    /// Sine and cosine of the tooth angle φ.
    pub direction: [f64; 2],
    /// sin κ, cos κ of the surface normal to the axis.
    pub normal: [f64; 2],
    /// Angle of the step, rad.
    pub step: f64,
}

/// Teeth back that may have left the surface.
pub(super) const MOST_WAYS: usize = 3;
/// Largest angle by which the tooth that left a surface stood aside, rad: only the very tip of a ball has more.
const ASIDE: f64 = 0.2;

impl Bite {
    /// Outward normal of the surface, frame of the engagement.
    pub fn outward(&self) -> V3 {
        let ([sin, cos], [sk, ck]) = (self.direction, self.normal);
        [sin * sk, cos * sk, -ck]
    }

    /// How the edge stands, for the law.
    pub fn turn(&self) -> Direction {
        Direction {
            tooth: self.direction,
            normal: self.normal,
        }
    }

    /// Mean of the chip over the step, m, and the part of the step in which there is one. `ways` with the
    /// longest memory first.
    pub fn chip(&self, ways: &[V3], tooth: usize, radii: &[f64]) -> (f64, f64) {
        let [sin, cos] = self.direction;
        let normal = self.outward();
        let teeth = radii.len();
        let mut least = (f64::INFINITY, 0.0);
        for (i, way) in ways.iter().enumerate() {
            let back = ways.len() - i;
            let before = radii[(tooth + back) % teeth];
            let turn = TAU * back as f64 / teeth as f64;
            // the earlier tooth stood on this ray an angle ε later: R sin ε = δ·t, δ = way (1 - ε/turn)
            let across = way[0] * cos - way[1] * sin;
            let aside = (across / (before + across / turn)).clamp(-ASIDE, ASIDE);
            let fall = 0.5 * before * aside * aside * self.normal[0];
            let chip = dot(*way, normal) * (1.0 - aside / turn) + radii[tooth] - before + fall;
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
    use crate::cutting::chip::{Steady, Stock, Tip};

    #[test]
    fn a_steady_way_takes_the_chip_of_its_trochoids() {
        let (q, teeth) = (0.12e-3 / TAU * 3.0, 3);
        let radii = [8.006e-3, 7.995e-3, 8.001e-3];
        let steady = Steady::<f64> {
            feed_per_radian: q,
            stock: Stock::Full,
            before: 0.0,
        };
        let tips = radii.map(|radius| Tip { radius, aside: 0.0 });
        let way = |m: usize| [q * TAU * m as f64 / teeth as f64, 0.0, 0.0];
        let ways = [way(3), way(2), way(1)];
        for tooth in 0..teeth {
            for phi in [0.2_f64, 0.8, 1.6, 2.4, 3.0] {
                let direction = [phi.sin(), phi.cos()];
                let exact = steady.bite(direction, tooth, &tips).thickness;
                let bite = Bite {
                    direction,
                    normal: [1.0, 0.0],
                    step: 1e-9,
                };
                let (chip, part) = bite.chip(&ways, tooth, &radii);
                assert!(
                    (chip - exact.max(0.0)).abs() < 2e-3 * 0.12e-3 && (part > 0.0) == (exact > 0.0),
                    "{tooth} {phi}: {chip} {exact}"
                );
            }
        }
    }
}
