use super::contract::{Card, Contact, Family, Law, Parameter, Scale};
use super::scene::Scene;
use super::shapes::Stop;
use crate::ground::dual::Scalar;

/// One friction contact in the load path.
pub struct CoulombFriction;

impl Law for CoulombFriction {
    const CARD: Card = Card {
        name: "coulomb_friction",
        cause: "coulomb_friction",
        family: Family::Physics,
        summary: "One dry contact holds the joint until its friction is overcome: lost motion at every reversal.",
        equation: "φ −= lost_motion · Sᵣ(M)/r, Sᵣ = stop operator, r = friction_load",
        source: "Jenkins 1962; play operator, Visintin 1994, ch. III (b = F_c/k)",
        signature: "straight flanks after each reversal, then the spring's slope; loop area grows in proportion to the amplitude",
        parameters: &[
            Parameter {
                name: "lost_motion",
                meaning: "half the width of the loop: deflection held back by friction",
                scale: Scale::Deflection,
                bounds: (0.0, 1.0),
                grid: &[0.05],
            },
            Parameter {
                name: "friction_load",
                meaning: "load that overcomes the friction",
                scale: Scale::Load,
                bounds: (0.01, 0.6),
                grid: &[0.02, 0.05, 0.09, 0.14, 0.2, 0.27, 0.36, 0.48],
            },
        ],
    };

    fn respond<S: Scalar>(p: &[S], scene: &Scene, _elastic: &[S], out: &mut [S]) {
        let (lost, friction) = (p[0], p[1]);
        let scale = lost / friction;
        let mut stop = Stop::<S>::new();
        let mut before = 0.0;
        for (y, load) in out.iter_mut().zip(&scene.load) {
            *y -= scale * stop.advance(load - before, friction);
            before = *load;
        }
    }

    fn contacts(p: &[f64]) -> Option<Vec<Contact>> {
        Some(vec![Contact {
            slip_load: p[1],
            compliance: p[0] / p[1],
        }])
    }
}
