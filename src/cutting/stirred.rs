//! What a tool that stands aside does to the force of a steady cut: the chip grows by the part along the ray of
//! every edge that cuts, as in the dynamic chip of regenerative theory (Altintas and Budak 1995).

use super::law::Direction;
use super::wave::Wave;
use crate::ground::dual::Scalar;
use crate::ground::spatial::{V3, add, scale};

impl<S: Scalar> Wave<'_, S> {
    /// Force per metre that the tool stands farther along the feed, and left of it, than the tooth before found
    /// it, N/m, when tooth 1 stands at `spindle` (rad) at the tip. `coefficients`: Ktc, Krc, Kac, Pa.
    pub fn stirred(&self, spindle: S, coefficients: [f64; 3]) -> [V3; 2] {
        let mut sums = [[0.0; 3]; 2];
        let [sin, cos] = [spindle.sin(), spindle.cos()];
        for (at, (disc, lags)) in self.discs.iter().zip(&self.lags).enumerate() {
            for (tooth, [s, c]) in lags.iter().enumerate() {
                let direction = [sin * *c + cos * *s, cos * *c - sin * *s];
                if !self.cuts(at, tooth, direction) {
                    continue;
                }
                let own = Direction {
                    tooth: direction.map(Scalar::value),
                    normal: disc.normal,
                };
                let force = own.force(coefficients.map(|k| k * disc.edge_m));
                for (sum, along) in sums.iter_mut().zip(own.tooth) {
                    *sum = add(*sum, scale(along * disc.normal[0], force));
                }
            }
        }
        sums
    }
}
