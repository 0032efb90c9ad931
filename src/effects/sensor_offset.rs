use super::contract::{Card, Family, Law, Parameter, Scale};
use super::scene::Scene;
use crate::ground::dual::Scalar;

/// A sensor that was not set to zero.
pub struct SensorOffset;

impl Law for SensorOffset {
    const CARD: Card = Card {
        name: "sensor_offset",
        cause: "sensor_offset",
        family: Family::Measurement,
        summary: "The sensor was not set to zero at the unloaded start.",
        equation: "φ_read = φ + offset",
        source: "tare error, VIM 2012, 4.28",
        signature: "the whole curve is shifted, the unloaded start included",
        parameters: &[Parameter {
            name: "offset",
            meaning: "reading without load at the start",
            scale: Scale::Deflection,
            bounds: (-10.0, 10.0),
            grid: &[0.05],
        }],
    };

    fn respond<S: Scalar>(p: &[S], _scene: &Scene, _elastic: &[S], out: &mut [S]) {
        for y in out.iter_mut() {
            *y += p[0];
        }
    }
}
