use super::contract::{Card, Family, Law, Parameter, Scale};
use super::scene::Scene;
use crate::ground::dual::Scalar;

/// The smooth cousin of distributed slip.
pub struct BoucWen;

impl Law for BoucWen {
    const CARD: Card = Card {
        name: "bouc_wen",
        cause: "hysteresis",
        family: Family::Physics,
        summary: "Smooth elastic hysteresis: slip sets in exponentially after each reversal.",
        equation: "φ −= width · z, dz = (dM/slip_load)(1 − sgn(dM)·z)",
        source: "Bouc 1967, Wen 1976, eq. 2 with n = 1, β = γ (driven by load), Dahl 1968",
        signature: "like hysteresis, with rounded branches that never quite end",
        parameters: &[
            Parameter {
                name: "width",
                meaning: "half the width of the loop once slip is complete",
                scale: Scale::Deflection,
                bounds: (0.0, 1.0),
                grid: &[0.05],
            },
            Parameter {
                name: "slip_load",
                meaning: "load after a reversal over which 63 % of the slip happens",
                scale: Scale::Load,
                bounds: (0.03, 2.0),
                grid: &[0.08, 0.2, 0.5],
            },
        ],
    };

    fn respond<S: Scalar>(p: &[S], scene: &Scene, _elastic: &[S], out: &mut [S]) {
        let (width, slip) = (p[0], p[1]);
        let mut z = S::constant(0.0);
        let mut before = 0.0;
        for (y, load) in out.iter_mut().zip(&scene.load) {
            let step = load - before;
            before = *load;
            // exact over one step of constant direction: z relaxes towards sgn(dM)
            let keep = (S::constant(-step.abs()) / slip).exp();
            z = z * keep + (-keep + 1.0) * if step == 0.0 { 0.0 } else { step.signum() };
            *y -= width * z;
        }
    }
}
