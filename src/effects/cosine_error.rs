use super::contract::{Card, Family, Law, Parameter, Role, Scale};
use super::scene::Scene;
use crate::ground::dual::Scalar;

/// A laser does not look along the motion.
pub struct CosineError;

impl Law for CosineError {
    const CARD: Card = Card {
        name: "cosine_error",
        cause: "cosine_error",
        family: Family::Measurement,
        summary: "The laser is inclined to the motion and reads only its component, or the load pulls aslant.",
        equation: "φ_read = (1 − shortfall) · φ, shortfall = 1 − cos(inclination)",
        source: "Abbe and cosine errors, ISO 230-1:2012, annex A",
        signature: "one laser reads too little of what moves along itself, or too much of a plate that moves square to its face",
        parameters: &[Parameter {
            name: "shortfall",
            meaning: "share of the motion that the inclined laser does not see",
            scale: Scale::One,
            bounds: (0.0, 0.5),
            grid: &[0.03],
        }],
    };
    const ROLE: Role = Role::Scale;

    fn respond<S: Scalar>(p: &[S], _scene: &Scene, _elastic: &[S], out: &mut [S]) {
        let factor = -p[0] + 1.0;
        for y in out.iter_mut() {
            *y *= factor;
        }
    }
}
