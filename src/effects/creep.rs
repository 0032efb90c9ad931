use super::contract::{Card, Family, Law, Parameter, Scale};
use super::scene::Scene;
use crate::ground::dual::Scalar;

/// Delayed elasticity.
pub struct Creep;

impl Law for Creep {
    const CARD: Card = Card {
        name: "creep",
        cause: "creep",
        family: Family::Physics,
        summary: "Part of the deflection follows the load late, and goes on under constant load.",
        equation: "φ += delayed · x, T ẋ = M/M̂ − x, M̂ = largest load",
        source: "standard linear solid (Kelvin–Voigt element in series), Zener 1948",
        signature: "the loop narrows when cycles are slower; drift during holds",
        parameters: &[
            Parameter {
                name: "delayed",
                meaning: "deflection that the largest load adds when held for ever",
                scale: Scale::Deflection,
                bounds: (0.0, 1.0),
                grid: &[0.05],
            },
            Parameter {
                name: "time_constant",
                meaning: "time in which 63 % of the delayed deflection has come",
                scale: Scale::Period,
                bounds: (0.01, 8.0),
                grid: &[0.02, 0.05, 0.11, 0.22, 0.45, 0.9, 2.0, 4.5],
            },
        ],
    };

    fn respond<S: Scalar>(p: &[S], scene: &Scene, _elastic: &[S], out: &mut [S]) {
        let (delayed, constant) = (p[0], p[1]);
        let mut x = S::constant(0.0);
        let mut before = None;
        for (y, (time, load)) in out.iter_mut().zip(scene.time.iter().zip(&scene.load)) {
            if let Some((last_time, last_load)) = before {
                let mean = 0.5 * (load + last_load) / scene.load_scale;
                let step: f64 = time - last_time;
                let keep = (S::constant(-step) / constant).exp();
                x = x * keep + (-keep + 1.0) * mean;
            }
            before = Some((time, load));
            *y += delayed * x;
        }
    }
}
