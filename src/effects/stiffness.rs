use super::contract::{Card, Family, Law, Parameter, Role, Scale};
use super::scene::Scene;
use crate::ground::dual::Scalar;

/// The stiffness in the simulation is wrong.
pub struct Stiffness;

impl Law for Stiffness {
    const CARD: Card = Card {
        name: "stiffness",
        cause: "stiffness",
        family: Family::Physics,
        summary: "The joint's real stiffness is not the one that the simulation uses.",
        equation: "φ += excess · M/k",
        source: "Englert 2011, eq. 3.1",
        signature: "a slope error that both lasers see alike",
        parameters: &[Parameter {
            name: "excess",
            meaning: "relative excess of the joint's compliance over the nominal one",
            scale: Scale::One,
            bounds: (-0.9, 9.0),
            grid: &[0.1],
        }],
    };
    const ROLE: Role = Role::Scale;

    fn respond<S: Scalar>(p: &[S], _scene: &Scene, elastic: &[S], out: &mut [S]) {
        for (y, s) in out.iter_mut().zip(elastic) {
            *y += p[0] * *s;
        }
    }
}
