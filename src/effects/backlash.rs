use super::contract::{Card, Family, Law, Parameter, Scale};
use super::scene::Scene;
use super::shapes::saturate;
use crate::ground::dual::Scalar;

/// Free gap.
pub struct Backlash;

/// Size of a gap, whatever law it has.
pub(super) const GAP: Parameter = Parameter {
    name: "gap",
    meaning: "total free travel between the two flanks",
    scale: Scale::Deflection,
    bounds: (0.0, 2.0),
    grid: &[0.1],
};
/// How suddenly its flanks meet.
pub(super) const CONTACT: Parameter = Parameter {
    name: "contact_load",
    meaning: "load over which the flanks come into contact",
    scale: Scale::Load,
    bounds: (5e-4, 0.1),
    grid: &[0.004, 0.02, 0.05],
};

impl Law for Backlash {
    const CARD: Card = Card {
        name: "backlash",
        cause: "backlash",
        family: Family::Physics,
        summary: "A free gap: the joint moves without load until its flanks meet.",
        equation: "φ += (gap/2) · x/√(1+x²), x = M/contact_load",
        source: "dead zone, Nordin and Gutman 2002, eq. 2, with contact that sets in over a small load",
        signature: "an odd step at zero load, single-valued, no loop; vanishes under preload",
        parameters: &[GAP, CONTACT],
    };

    fn respond<S: Scalar>(p: &[S], scene: &Scene, _elastic: &[S], out: &mut [S]) {
        let (half, contact) = (p[0] * 0.5, p[1]);
        for (y, load) in out.iter_mut().zip(&scene.load) {
            *y += half * saturate(S::constant(*load) / contact, 2.0);
        }
    }
}
