use super::contract::{Card, Family, Law, Parameter, Scale};
use super::scene::Scene;
use super::shapes::delayed;
use crate::ground::dual::Scalar;

/// The channels are not read at the same instant.
pub struct TimeSkew;

impl Law for TimeSkew {
    const CARD: Card = Card {
        name: "time_skew",
        cause: "time_skew",
        family: Family::Measurement,
        summary: "Deflection and load are not read at the same instant.",
        equation: "φ_read(t) = φ(t − delay)",
        source: "channel delay, Bendat and Piersol 2010, ch. 5.2",
        signature: "a loop as wide as the load is fast, none during holds",
        parameters: &[Parameter {
            name: "delay",
            meaning: "how much later than the load the deflection is read (negative: earlier)",
            scale: Scale::Period,
            bounds: (-0.08, 0.08),
            grid: &[0.003, 0.02, -0.02],
        }],
    };

    fn respond<S: Scalar>(p: &[S], scene: &Scene, _elastic: &[S], out: &mut [S]) {
        let read = out.to_vec();
        delayed(&scene.time, &read, p[0], out);
    }
}
