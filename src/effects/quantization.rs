use super::contract::{Card, Family, Law, Parameter, Role, Scale};
use super::scene::Scene;
use crate::ground::dual::Scalar;

/// A converter with coarse steps.
pub struct Quantization;

impl Law for Quantization {
    const CARD: Card = Card {
        name: "quantization",
        cause: "quantization",
        family: Family::Measurement,
        summary: "The converter or the file rounds the deflection to coarse steps.",
        equation: "φ_read = step · round(φ/step)",
        source: "Widrow and Kollár 2008, ch. 1: error variance step²/12",
        signature: "few distinct values, evenly spaced",
        parameters: &[Parameter {
            name: "step",
            meaning: "distance between neighbouring readings",
            scale: Scale::Deflection,
            bounds: (0.0, 1.0),
            grid: &[0.02],
        }],
    };
    const ROLE: Role = Role::Lattice;

    fn respond<S: Scalar>(p: &[S], _scene: &Scene, _elastic: &[S], out: &mut [S]) {
        let step = p[0].value();
        if step <= 0.0 {
            return;
        }
        for y in out.iter_mut() {
            // the rounding moves the value, not its slope
            let rounded = step * (y.value() / step).round();
            *y = y.chain(rounded, 1.0);
        }
    }
}
