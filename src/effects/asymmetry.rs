use super::contract::{Card, Family, Law, Parameter, Scale};
use super::scene::Scene;
use super::shapes::odd_power;
use crate::ground::dual::Scalar;

/// Tension and compression differ.
pub struct Asymmetry;

impl Law for Asymmetry {
    const CARD: Card = Card {
        name: "asymmetry",
        cause: "asymmetry",
        family: Family::Physics,
        summary: "The joint is softer in one direction of load than in the other.",
        equation: "φ += difference · |M/M̂|^p, M̂ = largest load",
        source: "bilinear stiffness, Kerschen et al. 2006, sec. 2; p = 1 is two stiffnesses",
        signature: "an even residual: the same sign under tension and compression, no loop",
        parameters: &[
            Parameter {
                name: "difference",
                meaning: "deflection added at the largest load in both directions, hence softer in tension, stiffer in compression",
                scale: Scale::Deflection,
                bounds: (-1.0, 1.0),
                grid: &[0.05],
            },
            Parameter {
                name: "exponent",
                meaning: "1: two constant stiffnesses with a kink at zero; above 1: without a kink",
                scale: Scale::One,
                bounds: (0.8, 2.2),
                grid: &[1.0, 1.6],
            },
        ],
    };

    fn respond<S: Scalar>(p: &[S], scene: &Scene, _elastic: &[S], out: &mut [S]) {
        let (difference, exponent) = (p[0], p[1]);
        for (y, load) in out.iter_mut().zip(&scene.load) {
            let u = (load / scene.load_scale).abs();
            *y += difference * even_power(u, exponent);
        }
    }
}

fn even_power<S: Scalar>(u: f64, exponent: S) -> S {
    if u < 1e-12 {
        return S::constant(0.0);
    }
    odd_power(S::constant(u), exponent)
}
