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

/// Slope below which a softening joint does not fall: beyond its limit load it goes on with it.
const LEAST_SLOPE: f64 = 0.05;

/// Root v of v + h·sgn(v)|v|^p = u by Newton; the derivative by the implicit function theorem.
/// Where softening would take the slope below [`LEAST_SLOPE`] the law goes on straight.
fn solve<S: Scalar>(u: S, h: S, exponent: S) -> S {
    let (target, hv, p) = (u.value().abs(), h.value(), exponent.value());
    let limit = match hv < 0.0 {
        true => ((LEAST_SLOPE - 1.0) / (hv * p)).powf(1.0 / (p - 1.0)),
        false => f64::INFINITY,
    };
    let bent = |v: f64| v + hv * v.powf(p);
    if limit.is_finite() && target > bent(limit) {
        let straight = limit + (target - bent(limit)) / LEAST_SLOPE;
        let slope = LEAST_SLOPE;
        let root = S::constant(straight * u.value().signum());
        let reach = S::constant(limit * u.value().signum());
        let residual = h * odd_power(reach, exponent) - u;
        return root - (residual - residual.value()) / slope;
    }
    let v = newton(target, hv, p, limit) * u.value().signum();
    let slope = 1.0 + hv * p * v.abs().powf(p - 1.0);
    let root = S::constant(v);
    let residual = root + h * odd_power(root, exponent) - u;
    root - (residual - residual.value()) / slope
}

/// Non-negative root of v + h v^p = target below `limit`, where the left side rises.
fn newton(target: f64, h: f64, p: f64, limit: f64) -> f64 {
    let mut v = target.min(limit);
    for _ in 0..60 {
        let power = v.powf(p - 1.0);
        let slope = (1.0 + h * p * power).max(LEAST_SLOPE);
        let step = (v + h * v * power - target) / slope;
        v = (v - step).clamp(0.0, limit);
        if step.abs() < 1e-14 {
            break;
        }
    }
    v
}
