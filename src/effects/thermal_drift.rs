use super::contract::{Card, Family, Law, Parameter, Scale};
use super::scene::Scene;
use crate::ground::dual::Scalar;

/// The sensor or its beam warms up.
pub struct ThermalDrift;

impl Law for ThermalDrift {
    const CARD: Card = Card {
        name: "thermal_drift",
        cause: "thermal_drift",
        family: Family::Measurement,
        summary: "Sensor, beam or robot warms up and the zero wanders.",
        equation: "φ_read = φ + drift · (1 − e^(−t/T))/(1 − e^(−D/T)), D = duration of the record",
        source: "first-order warm-up, ISO 230-3:2020, annex A",
        signature: "loops do not close; the misfit follows time, not load",
        parameters: &[
            Parameter {
                name: "drift",
                meaning: "change of the zero from start to end of the record",
                scale: Scale::Deflection,
                bounds: (-10.0, 10.0),
                grid: &[0.05],
            },
            Parameter {
                name: "warm_up",
                meaning: "time constant of the warm-up",
                scale: Scale::Duration,
                bounds: (0.12, 20.0),
                grid: &[0.2, 0.5, 10.0],
            },
        ],
    };

    fn respond<S: Scalar>(p: &[S], scene: &Scene, _elastic: &[S], out: &mut [S]) {
        let (drift, constant) = (p[0], p[1]);
        let start = scene.time.first().copied().unwrap_or(0.0);
        let full = -(S::constant(-scene.duration) / constant).exp() + 1.0;
        for (y, t) in out.iter_mut().zip(&scene.time) {
            let so_far = -(S::constant(start - t) / constant).exp() + 1.0;
            *y += drift * so_far / full;
        }
    }
}
