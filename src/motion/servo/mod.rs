//! A screw axis led by a motion card: a position loop of high gain closed over the motor's encoder, the
//! screw's error and its lost motion behind it (source 003, sections 2.2 and 3.1).
//!
//! The scale that measured the screw is not part of the loop ("half-closed"): a correction is added to the
//! following error, and whatever it does from one sample to the next the loop amplifies.

mod course;
mod stroke;

pub use course::{Instant, SETTLED, course};
pub use stroke::{Command, Stroke};

use std::f64::consts::{PI, TAU};

/// Motor, screw and slide as one mass at the slide, and the encoder.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drive {
    /// Mass that the motor moves, its own inertia and the screw's referred to the slide, kg.
    pub mass: f64,
    /// Viscous friction, N·s/m.
    pub viscous: f64,
    /// Dry friction, N.
    pub dry: f64,
    /// Largest force of the motor at the slide, N.
    pub force_limit: f64,
    /// Travel per count of the encoder, m.
    pub count: f64,
}

impl Drive {
    /// The axis of source 003 for a screw of this pitch (m): motor SGMAH-04A (0.173e-4 kg·m², 3.82 N·m at
    /// the most, 8192 counts per turn: its catalogue), a steel screw of 15.2 mm and half a metre (0.21e-4
    /// kg·m²). The slide's 10 kg and the frictions are ours, of ordinary size.
    pub fn of_pitch(pitch: f64) -> Self {
        let lever = pitch / TAU;
        Self {
            mass: (0.173e-4 + 0.21e-4) / lever.powi(2) + 10.0,
            viscous: 100.0,
            dry: 40.0,
            force_limit: 3.82 / lever,
            count: pitch / 8192.0,
        }
    }
}

/// The card's loop: PID on the following error with the commanded speed and acceleration fed forward.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Loop {
    /// Sampling interval, s.
    pub sample: f64,
    /// Proportional, N/m; derivative, N·s/m; integral, N/(m·s).
    pub gains: [f64; 3],
}

/// Sampling of the card for one axis, s (source 003, 2.2).
const SAMPLE: f64 = 62.5e-6;
/// Bandwidth of a loop of high gain, Hz: what a rigid screw axis at this sampling carries easily.
pub const BANDWIDTH: f64 = 50.0;

impl Loop {
    /// All three poles of a mass at −2π·`bandwidth` (Hz): as stiff as it gets without overshoot of its own.
    pub fn with_bandwidth(drive: &Drive, bandwidth: f64) -> Self {
        let w = 2.0 * PI * bandwidth;
        Self {
            sample: SAMPLE,
            gains: [3.0 * w * w, 3.0 * w, w.powi(3)].map(|g| g * drive.mass),
        }
    }
}

/// The screw behind the encoder.
pub struct Screw<'a> {
    /// How far the nut lies beyond where the encoder says, m, at a position, m.
    pub error: &'a dyn Fn(f64) -> f64,
    /// Whole play between nut and slide, m.
    pub play: f64,
}
