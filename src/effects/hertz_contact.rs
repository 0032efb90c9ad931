use super::contract::{Card, Family, Law, Parameter, Scale};
use super::scene::Scene;
use super::shapes::odd_power;
use crate::ground::dual::Scalar;

/// Contacts whose area grows with the load, in series with the spring.
pub struct HertzContact;

impl Law for HertzContact {
    const CARD: Card = Card {
        name: "hertz_contact",
        cause: "cubic_stiffness",
        family: Family::Physics,
        summary: "The joint hardens (or softens) progressively with load: contacts flatten.",
        equation: "φ += approach·sgn(M)·|M/M̂|^e, M̂ = largest load; e = 2/3 for balls and crowned flanks, 0.9 for rollers",
        source: "Hertz 1882; Harris and Kotzalas 2007, ch. 6 (balls) and Palmgren 1959 (rollers)",
        signature: "single-valued, odd, steepest at zero load like a gap, but without a flank",
        parameters: &[
            Parameter {
                name: "approach",
                meaning: "deflection of the contacts at the largest load",
                scale: Scale::Deflection,
                bounds: (0.0, 2.0),
                grid: &[0.1],
            },
            Parameter {
                name: "power",
                meaning: "power of the load with which they give way",
                scale: Scale::One,
                bounds: (0.3, 0.92),
                grid: &[0.5, 0.667, 0.85],
            },
        ],
    };

    fn respond<S: Scalar>(p: &[S], scene: &Scene, _elastic: &[S], out: &mut [S]) {
        let (approach, power) = (p[0], p[1]);
        for (y, load) in out.iter_mut().zip(&scene.load) {
            *y += approach * odd_power(S::constant(*load / scene.load_scale), power);
        }
    }
}
