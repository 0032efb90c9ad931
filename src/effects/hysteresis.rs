use super::contract::{Card, Contact, Family, Law, Parameter, Scale};
use super::scene::Scene;
use super::shapes::Stop;
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
        equation: "φ −= width · Σᵢ wᵢ Sᵣᵢ(M)/Σᵢ wᵢ rᵢ, Sᵣ = stop operator, rᵢ = slip_load·xᵢ, w(x) = x^(spread−1)·e^(tilt·x), 0 < x < 1",
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
                grid: &[0.22, 0.45, 0.7, 1.0],
            },
            Parameter {
                name: "spread",
                meaning: "power of the distribution of slip loads (1: even; below: many slip at once; above: few slip early)",
                scale: Scale::One,
                bounds: (0.5, 1.8),
                grid: &[1.0],
            },
            Parameter {
                name: "tilt",
                meaning: "whether more contacts slip early (negative) or late (positive)",
                scale: Scale::One,
                bounds: (-5.0, 4.0),
                grid: &[-3.0, -0.5, 2.0],
            },
        ],
    };

    fn respond<S: Scalar>(p: &[S], scene: &Scene, _elastic: &[S], out: &mut [S]) {
        let (weights, thresholds) = elements(p);
        let mut stops = [Stop::<S>::new(); ELEMENTS];
        let mut before = 0.0;
        for (y, load) in out.iter_mut().zip(&scene.load) {
            let step = load - before;
            before = *load;
            let mut total = S::constant(0.0);
            for i in 0..ELEMENTS {
                total += weights[i] * stops[i].advance(step, thresholds[i]);
            }
            *y -= total;
        }
    }

    fn contacts(p: &[f64]) -> Option<Vec<Contact>> {
        let (weights, thresholds) = elements(p);
        let contact = |(compliance, slip_load)| Contact {
            slip_load,
            compliance,
        };
        Some(weights.into_iter().zip(thresholds).map(contact).collect())
    }
}

/// What each Jenkins element holds back per load, and the load at which it slips.
fn elements<S: Scalar>(p: &[S]) -> ([S; ELEMENTS], [S; ELEMENTS]) {
    let (width, slip, spread, tilt) = (p[0], p[1], p[2], p[3]);
    let shares: [f64; ELEMENTS] =
        std::array::from_fn(|i| ((i as f64 + 0.5) / ELEMENTS as f64).powf(1.3));
    let weights =
        shares.map(|x| ((spread - 1.0) * x.ln() + tilt * (x - 0.5)).exp() * x.powf(0.3 / 1.3));
    let sum = (0..ELEMENTS).fold(S::constant(0.0), |sum, i| sum + weights[i] * shares[i]);
    let scale = width / (sum * slip);
    (weights.map(|w| w * scale), shares.map(|x| slip * x))
}
