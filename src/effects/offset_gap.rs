use super::backlash::{CONTACT, GAP};
use super::contract::{Card, Family, Law, Parameter, Scale};
use super::scene::Scene;
use super::shapes::saturate_as;
use crate::ground::dual::Scalar;

/// Free gap that a weight or a preload shifts.
pub struct OffsetGap;

impl Law for OffsetGap {
    const CARD: Card = Card {
        name: "offset_gap",
        cause: "backlash",
        family: Family::Physics,
        summary: "A free gap that lies at some load: a weight or a preload holds it to one side.",
        equation: "φ += (gap/2) · (s((M − centre)/contact_load) − s(−centre/contact_load)), s(x) = x/(1+|x|^edge)^(1/edge)",
        source: "dead zone, Nordin and Gutman 2002, eq. 2, with contact that sets in over a small load, about any load",
        signature: "a step at one load, single-valued, no loop; the zero is set where the record has no load",
        parameters: &[
            GAP,
            Parameter {
                grid: &[0.008, 0.03],
                ..CONTACT
            },
            Parameter {
                name: "centre",
                meaning: "load at which the joint hangs between its flanks",
                scale: Scale::Load,
                bounds: (-0.45, 0.45),
                grid: &[-0.25, -0.1, 0.1, 0.25],
            },
            Parameter {
                name: "edge",
                meaning: "how suddenly the flanks meet: 1 for a round contact, 8 for a sharp one",
                scale: Scale::One,
                bounds: (1.0, 8.0),
                grid: &[2.0],
            },
        ],
    };

    fn respond<S: Scalar>(p: &[S], scene: &Scene, _elastic: &[S], out: &mut [S]) {
        let (half, contact, centre, edge) = (p[0] * 0.5, p[1], p[2], p[3]);
        let step = |load: f64| saturate_as((S::constant(load) - centre) / contact, edge);
        let zero = step(0.0);
        for (y, load) in out.iter_mut().zip(&scene.load) {
            *y += half * (step(*load) - zero);
        }
    }
}
