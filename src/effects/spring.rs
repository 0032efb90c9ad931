use super::contract::{Card, Family, Law, Parameter, Role, Scale};
use super::scene::Scene;
use crate::ground::dual::Scalar;

/// The linear spring of the joint.
pub struct Spring;

impl Law for Spring {
    const CARD: Card = Card {
        name: "spring",
        cause: "spring",
        family: Family::Physics,
        summary: "The joint deflects in proportion to its load.",
        equation: "φ = M / k",
        source: "Englert 2011, eq. 3.1",
        signature: "a straight line through the origin, no loop",
        parameters: &[Parameter {
            name: "stiffness",
            meaning: "load per deflection of the joint's spring, at full load, with lost motion and friction taken out",
            scale: Scale::Stiffness,
            bounds: (1e-3, 1e3),
            grid: &[1.0],
        }],
    };
    const ROLE: Role = Role::Base;

    fn respond<S: Scalar>(p: &[S], scene: &Scene, _elastic: &[S], out: &mut [S]) {
        let compliance = S::constant(1.0) / p[0];
        for (y, load) in out.iter_mut().zip(&scene.load) {
            *y += compliance * *load;
        }
    }
}
