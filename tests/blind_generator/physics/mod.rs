//! The effects of the library, each by formulas of this generator's own.
//!
//! All loads are shares of the largest load, all deflections shares of the deflection of the plain
//! spring at that load. Effects are extra flexibility in series with the spring, so the stiffness
//! stated in the file is the outer slope of a gap or soft zone, the small-load slope of a cubic law,
//! the slope right after reversal of a hysteretic joint, and the instantaneous one of a creeping joint.

pub mod creep;
pub mod cubic;
pub mod friction;
pub mod gap;
pub mod hysteresis;
pub mod parallel;
pub mod sensing;
pub mod wear;

use super::line::{Line, peak};
use super::random::Random;
use super::schedule::Schedule;

/// An effect's formula before its size is known.
pub enum Law {
    /// Grows in proportion to its amplitude: the response to amplitude 1 on the fine grid, and the
    /// largest believable amplitude.
    Added {
        shape: Vec<f64>,
        largest: f64,
        amplitude_name: &'static str,
        line: Line,
    },
    /// Cubic spring, solved for its deflection.
    Cubic { hardening: bool },
    /// Reading late (or early) against the force.
    Delay { early: bool },
    /// Load cell that stops at a level, on both sides or on one.
    Saturation { sides: (bool, bool) },
    /// First laser's lever is not what the file states.
    LeverArm { longer: bool },
    /// First laser looks at an angle.
    CosineError,
    /// The joint's stiffness is not the stated one.
    Stiffness { stiffer: bool },
    /// Readings stand on a lattice.
    Lattice,
}

/// An effect drawn for a schedule.
pub struct Drawn {
    pub law: Law,
    pub parameters: Vec<(&'static str, f64)>,
}

/// An effect that adds `amplitude * shape` to the deflection.
pub fn added(
    shape: Vec<f64>,
    largest: f64,
    amplitude_name: &'static str,
    parameters: Vec<(&'static str, f64)>,
) -> Drawn {
    let line = Line::Full;
    Drawn {
        law: Law::Added {
            shape,
            largest,
            amplitude_name,
            line,
        },
        parameters,
    }
}

/// Divides by the largest absolute value.
pub fn to_unit_peak(mut shape: Vec<f64>) -> Vec<f64> {
    let largest = shape.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    shape.iter_mut().for_each(|x| *x /= largest.max(1e-300));
    shape
}

/// Draws the law of a named effect; `None` if this module does not know it.
pub fn draw(effect: &str, schedule: &Schedule, random: &mut Random) -> Option<Drawn> {
    let bare = |law| Drawn {
        law,
        parameters: Vec::new(),
    };
    Some(match effect {
        "backlash" => gap::backlash(schedule, random),
        "soft_zone" => gap::soft_zone(schedule, random),
        "asymmetry" => gap::asymmetry(schedule, random),
        "cubic_stiffness" => bare(Law::Cubic {
            hardening: random.chance(0.65),
        }),
        "hysteresis" => hysteresis::draw(schedule, random),
        "coulomb_friction" => friction::draw(schedule, random),
        "creep" => creep::draw(schedule, random),
        "loosening" => wear::loosening(schedule, random),
        "slip" => wear::slip(schedule, random),
        "sensor_offset" => sensing::offset(schedule, random),
        "thermal_drift" => sensing::drift(schedule, random),
        "time_skew" => bare(Law::Delay {
            early: random.chance(0.3),
        }),
        "quantization" => bare(Law::Lattice),
        "lever_arm" => bare(Law::LeverArm {
            longer: random.chance(0.5),
        }),
        "cosine_error" => bare(Law::CosineError),
        "stiffness" => bare(Law::Stiffness {
            stiffer: random.chance(0.5),
        }),
        _ => return None,
    })
}

/// Longest believable delay, as a share of a cycle.
const LONGEST_DELAY: f64 = 0.05;

/// Smallest and largest size an effect may have, as the peak beyond the straight line over the
/// spring's peak deflection. The uncertainties are those stated for levers and stiffness.
pub fn sizes(drawn: &Drawn, schedule: &Schedule, lever: f64, stiffness: f64) -> (f64, f64) {
    let load = schedule.sampled(&schedule.load);
    match &drawn.law {
        Law::Added {
            shape,
            largest,
            line,
            ..
        } => (0.0, largest * peak(&schedule.sampled(shape), &load, *line)),
        Law::Cubic { hardening } => (0.0, cubic::size(&load, cubic::strongest(*hardening))),
        Law::Delay { .. } => (
            0.0,
            sensing::skew_size(schedule, LONGEST_DELAY * schedule.period),
        ),
        Law::Saturation { sides } => (
            sensing::saturation_size(&load, 0.95, *sides),
            sensing::saturation_size(&load, 0.8, *sides),
        ),
        Law::LeverArm { .. } => (over_reading(6.0 * lever), 0.15),
        Law::CosineError => (over_reading((6.0 * lever).max(0.0098)), 0.103),
        Law::Stiffness { .. } => (5.0 * stiffness, 0.4),
        Law::Lattice => (0.0, f64::INFINITY),
    }
}

/// A reading short by this share, related to the short reading.
fn over_reading(share: f64) -> f64 {
    1.0001 * share / (1.0 - share)
}

/// An effect at its size: what it does to the chain from load to file.
pub struct Sized {
    /// Added to the spring's deflection, fine grid, over the spring's peak deflection.
    pub added: Option<Vec<f64>>,
    /// The load channel as reported, fine grid, if it is not the load itself.
    pub reported: Option<Vec<f64>>,
    pub delay: f64,
    /// True lever (or slant) of laser 1 over the stated one.
    pub gain: f64,
    /// True stiffness over the stated one.
    pub stiffness: f64,
    pub lattice: bool,
    /// Amplitude over the spring's peak deflection, to be printed in rad.
    pub amplitude: Option<(&'static str, f64)>,
    pub parameters: Vec<(&'static str, f64)>,
}

impl Sized {
    fn none(parameters: Vec<(&'static str, f64)>) -> Self {
        Self {
            added: None,
            reported: None,
            delay: 0.0,
            gain: 1.0,
            stiffness: 1.0,
            lattice: false,
            amplitude: None,
            parameters,
        }
    }
}

/// Gives a drawn effect the wanted size (see [`sizes`]).
pub fn size(drawn: Drawn, schedule: &Schedule, size: f64) -> Sized {
    let mut sized = Sized::none(drawn.parameters);
    match drawn.law {
        Law::Added {
            shape,
            amplitude_name,
            line,
            ..
        } => {
            let load = schedule.sampled(&schedule.load);
            let amplitude = size / peak(&schedule.sampled(&shape), &load, line);
            sized.amplitude = Some((amplitude_name, amplitude));
            sized.added = Some(shape.into_iter().map(|x| amplitude * x).collect());
        }
        Law::Cubic { hardening } => {
            let ratio = cubic::ratio_for(&schedule.sampled(&schedule.load), hardening, size);
            sized
                .parameters
                .push(("cubic_over_linear_at_full_load", ratio));
            sized.added = Some(cubic::response(&schedule.load, ratio));
        }
        Law::Delay { early } => {
            let delay = sensing::skew_for(schedule, early, LONGEST_DELAY * schedule.period, size);
            sized.parameters.push(("delay_s", delay));
            sized.delay = delay;
        }
        Law::Saturation { sides } => {
            let level = sensing::saturation_for(&schedule.sampled(&schedule.load), sides, size);
            sized.parameters.push(("level_of_max", level));
            sized.reported = Some(sensing::saturate(&schedule.load, level, sides));
        }
        Law::LeverArm { longer } => {
            let error = if longer {
                size / (1.0 - size)
            } else {
                -size / (1.0 + size)
            };
            sized.parameters.push(("lever_error", error));
            sized.gain = 1.0 + error;
        }
        Law::CosineError => {
            sized.gain = 1.0 / (1.0 + size);
            let alpha = sized.gain.acos().to_degrees();
            sized.parameters.push(("inclination_deg", alpha));
        }
        Law::Stiffness { stiffer } => {
            let deviation = if stiffer { size } else { -size };
            sized.parameters.push(("stiffness_deviation", deviation));
            sized.stiffness = 1.0 + deviation;
        }
        Law::Lattice => sized.lattice = true,
    }
    sized
}
