use super::contract::{Card, Family, Law, Parameter, Role, Scale};
use super::scene::Scene;
use crate::ground::dual::Scalar;

/// A lever is not as long as the file says.
pub struct LeverArm;

impl Law for LeverArm {
    const CARD: Card = Card {
        name: "lever_arm",
        cause: "lever_arm",
        family: Family::Measurement,
        summary: "A lever, of the sensor or of the load, is not as long as the file says, so every angle is scaled.",
        equation: "φ_read = (1 + error) · φ",
        source: "φ = d/L with L wrong by a constant factor",
        signature: "a slope error of one laser only; offsets and noise scale with it",
        parameters: &[Parameter {
            name: "error",
            meaning: "relative excess of the true lever over the stated one",
            scale: Scale::One,
            bounds: (-0.6, 1.5),
            grid: &[0.05],
        }],
    };
    const ROLE: Role = Role::Scale;

    fn respond<S: Scalar>(p: &[S], _scene: &Scene, _elastic: &[S], out: &mut [S]) {
        let factor = p[0] + 1.0;
        for y in out.iter_mut() {
            *y *= factor;
        }
    }
}
