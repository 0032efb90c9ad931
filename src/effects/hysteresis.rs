use super::contract::{Card, Family, Law, Parameter, Scale};
use super::scene::Scene;
use super::shapes::{Stop, ln};
use crate::ground::dual::Scalar;

/// Distributed slip: elastic hysteresis with Masing branches.
pub struct Hysteresis;

/// Number of Jenkins elements that sample the distribution of slip loads.
const ELEMENTS: usize = 12;

impl Law for Hysteresis {
    const CARD: Card = Card {
        name: "hysteresis",
        cause: "hysteresis",
        family: Family::Physics,
        summary: "Many small contacts slip at different loads: unloading runs above loading.",
        equation: "φ −= width · Σᵢ Sᵣᵢ(M)/Σᵢ rᵢ, Sᵣ = stop operator, rᵢ = slip_load·((i−½)/12)^(1/spread)",
        source: "Iwan 1966, eq. 3 (Maxwell-slip with distributed thresholds); Masing 1926",
        signature: "a closed, rate-independent loop with gradual slip; area grows with a power of 2 to 3 of the amplitude",
        parameters: &[
            Parameter {
                name: "width",
                meaning: "half the width of the loop once every contact has slipped",
                scale: Scale::Deflection,
                bounds: (0.0, 1.0),
                grid: &[0.05],
            },
            Parameter {
                name: "slip_load",
                meaning: "load at which the last contact slips",
                scale: Scale::Load,
                bounds: (0.08, 1.0),
                grid: &[0.2, 0.4, 0.65, 1.0],
            },
            Parameter {
                name: "spread",
                meaning: "distribution of the slip loads (1: even; below: most slip early; above: most slip late)",
                scale: Scale::One,
                bounds: (0.4, 3.0),
                grid: &[0.6, 1.3],
            },
        ],
    };

    fn respond<S: Scalar>(p: &[S], scene: &Scene, _elastic: &[S], out: &mut [S]) {
        let (width, slip, spread) = (p[0], p[1], p[2]);
        let thresholds: [S; ELEMENTS] = std::array::from_fn(|i| {
            let share = (i as f64 + 0.5) / ELEMENTS as f64;
            slip * (ln(S::constant(share)) / spread).exp()
        });
        let sum = thresholds.iter().fold(S::constant(0.0), |a, r| a + *r);
        let scale = width / sum;
        let mut stops = [Stop::<S>::new(); ELEMENTS];
        let mut before = 0.0;
        for (y, load) in out.iter_mut().zip(&scene.load) {
            let step = load - before;
            before = *load;
            let mut total = S::constant(0.0);
            for (stop, threshold) in stops.iter_mut().zip(&thresholds) {
                total += stop.advance(step, *threshold);
            }
            *y -= scale * total;
        }
    }
}
