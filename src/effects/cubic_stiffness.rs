use super::contract::{Card, Family, Law, Parameter, Scale};
use super::scene::Scene;
use super::shapes::odd_power;
use crate::ground::dual::Scalar;

/// Stiffness that grows or falls with load.
pub struct CubicStiffness;

impl Law for CubicStiffness {
    const CARD: Card = Card {
        name: "cubic_stiffness",
        cause: "cubic_stiffness",
        family: Family::Physics,
        summary: "The joint hardens (or softens) progressively with load.",
        equation: "M/k = y + hardening·ŷ·|y/ŷ|^p·sgn y, ŷ = deflection at the largest load; p = 3 is M = k y + k₃ y³",
        source: "Duffing-type gear characteristic, Spong 1987; Worden and Tomlinson 2001, ch. 2",
        signature: "single-valued, odd, S-shaped residual of a line fit, no knee, no loop",
        parameters: &[
            Parameter {
                name: "hardening",
                meaning: "share of the spring's moment that the progressive part carries at the largest load (negative: softening)",
                scale: Scale::One,
                bounds: (-0.25, 4.0),
                grid: &[0.03, 0.4, -0.12],
            },
            Parameter {
                name: "exponent",
                meaning: "power of the progressive part (3: cubic)",
                scale: Scale::One,
                bounds: (2.0, 5.0),
                grid: &[2.3, 3.2],
            },
        ],
    };

    fn respond<S: Scalar>(p: &[S], scene: &Scene, elastic: &[S], out: &mut [S]) {
        let (h, exponent) = (p[0], p[1]);
        let full = scene.deflection_scale;
        for (y, s) in out.iter_mut().zip(elastic) {
            let u = *s / full;
            *y += (solve(u, h, exponent) - u) * full;
        }
    }
}

/// Root v of v + h·sgn(v)|v|^p = u by Newton; the derivative by the implicit function theorem.
fn solve<S: Scalar>(u: S, h: S, exponent: S) -> S {
    let (target, hv, p) = (u.value(), h.value(), exponent.value());
    let mut v = target;
    for _ in 0..30 {
        let power = v.abs().powf(p - 1.0);
        let f = v + hv * v * power - target;
        let slope = (1.0 + hv * p * power).max(0.05);
        let step = f / slope;
        v -= step;
        if step.abs() < 1e-14 {
            break;
        }
    }
    let slope = (1.0 + hv * p * v.abs().powf(p - 1.0)).max(0.05);
    let root = S::constant(v);
    let residual = root + h * odd_power(root, exponent) - u;
    root - (residual - residual.value()) / slope
}
