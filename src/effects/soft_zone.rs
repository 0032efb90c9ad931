use super::contract::{Card, Family, Law, Parameter, Scale};
use super::scene::Scene;
use super::shapes::saturate;
use crate::ground::dual::Scalar;

/// Softer around zero load.
pub struct SoftZone;

impl Law for SoftZone {
    const CARD: Card = Card {
        name: "soft_zone",
        cause: "soft_zone",
        family: Family::Physics,
        summary: "The joint is softer below a certain load: its contacts close one after another.",
        equation: "φ += extra · clip(M / zone_load), clip rounded with x/(1+|x|⁴)^¼",
        source: "piecewise-linear gear stiffness, Seyfferth, Maghzal and Angeles 1995",
        signature: "single-valued, odd, a knee on either side of zero; small loads look soft",
        parameters: &[
            Parameter {
                name: "extra",
                meaning: "deflection gained over the soft zone on one side, beyond the spring's",
                scale: Scale::Deflection,
                bounds: (0.0, 2.0),
                grid: &[0.1],
            },
            Parameter {
                name: "zone_load",
                meaning: "load at which the soft zone ends",
                scale: Scale::Load,
                bounds: (0.1, 0.75),
                grid: &[0.12, 0.18, 0.26, 0.36, 0.48, 0.62],
            },
            Parameter {
                name: "sharpness",
                meaning: "how sharp the knee is (2: round, 20: a corner)",
                scale: Scale::One,
                bounds: (2.0, 30.0),
                grid: &[4.0, 14.0],
            },
        ],
    };

    fn respond<S: Scalar>(p: &[S], scene: &Scene, _elastic: &[S], out: &mut [S]) {
        let (extra, zone, sharpness) = (p[0], p[1], p[2]);
        for (y, load) in out.iter_mut().zip(&scene.load) {
            *y += extra * knee(S::constant(*load) / zone, sharpness);
        }
    }
}

/// x/(1+|x|^p)^(1/p) with p a parameter as well.
fn knee<S: Scalar>(x: S, p: S) -> S {
    let a = x.value().abs();
    if a < 1e-9 {
        return saturate(x, p.value());
    }
    let base = saturate(x, p.value());
    // ∂/∂p of −ln(1+a^p)/p, by hand: the exponent is a shape, not a port.
    let (q, la) = (p.value(), a.ln());
    let power = a.powf(q).min(1e12);
    let slope = (power.ln_1p() / q - power * la / (1.0 + power)) / q;
    base + p.chain(0.0, base.value() * slope)
}
