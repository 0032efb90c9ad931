//! What is wrong with a cut, its tool or the dynamometer: wave forms of force less the simulation.

mod aim;
mod anew;
mod arrived;
mod case;
mod channels;
mod chatter;
mod chipped_tooth;
mod coefficients;
mod cross_talk;
mod direction;
mod engagement;
mod experiment;
mod force_gain;
mod lines;
mod noise;
mod patterns;
mod revolution;
mod ringing;
mod runout;
mod sensor;
mod sensor_offset;
mod sensor_resonance;
mod setting;
mod sought;
mod spindle_speed;
mod start;
mod thermal_drift;
mod tremor;

use super::table::Effect;
pub use case::{Case, CutSamples};

/// Every effect of this kind.
pub const EFFECTS: &[Effect<Case>] = &[
    coefficients::CUTTING,
    coefficients::EDGE,
    runout::EFFECT,
    chipped_tooth::EFFECT,
    engagement::WIDTH,
    engagement::DEPTH,
    spindle_speed::EFFECT,
    force_gain::EFFECT,
    cross_talk::EFFECT,
    sensor_offset::EFFECT,
    thermal_drift::EFFECT,
    sensor_resonance::EFFECT,
    chatter::EFFECT,
];
