use super::contract::{Card, Family, Law, Parameter, Scale};
use super::scene::Scene;
use crate::ground::dual::Scalar;

/// The fixture moves once.
pub struct Slip;

impl Law for Slip {
    const CARD: Card = Card {
        name: "slip",
        cause: "slip",
        family: Family::Physics,
        summary: "The fixture or a connection slipped once and stayed where it went.",
        equation: "φ += jump · clip((t − instant)/duration), from 0 to 1",
        source: "step change of a mean, Page 1955",
        signature: "loops before and after one instant are the same but shifted",
        parameters: &[
            Parameter {
                name: "jump",
                meaning: "permanent displacement",
                scale: Scale::Deflection,
                bounds: (-1.0, 1.0),
                grid: &[0.05],
            },
            Parameter {
                name: "instant",
                meaning: "when it began, from the start of the record",
                scale: Scale::Duration,
                bounds: (0.01, 0.99),
                grid: &INSTANTS,
            },
            Parameter {
                name: "duration",
                meaning: "how long it took",
                scale: Scale::Duration,
                bounds: (1e-4, 0.04),
                grid: &[0.004],
            },
        ],
    };

    fn respond<S: Scalar>(p: &[S], scene: &Scene, _elastic: &[S], out: &mut [S]) {
        let (jump, instant, duration) = (p[0], p[1], p[2]);
        let start = scene.time.first().copied().unwrap_or(0.0);
        for (y, t) in out.iter_mut().zip(&scene.time) {
            let passed = (-instant + (t - start)) / duration;
            *y += jump * passed.max(S::constant(0.0)).min(S::constant(1.0));
        }
    }
}

const INSTANTS: [f64; 64] = evenly();

const fn evenly() -> [f64; 64] {
    let mut grid = [0.0; 64];
    let mut i = 0;
    while i < 64 {
        grid[i] = 0.02 + 0.96 * i as f64 / 63.0;
        i += 1;
    }
    grid
}
