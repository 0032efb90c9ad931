//! What a dynamometer makes of forces.

use crate::experiments::resonance::Resonant;
use crate::ground::spatial::M3;

/// A sensor: how forces ring in it, and then what each of its axes shows of them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sensor {
    /// The readings over the forces.
    pub map: M3,
    /// How it rings.
    pub resonant: Option<Resonant>,
}

/// One that shows what there is.
pub(super) const SOUND: Sensor = Sensor {
    map: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    resonant: None,
};
