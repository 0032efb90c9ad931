//! Single-valued piecewise laws: clearance, soft zone, unequal sides.

use super::super::random::Random;
use super::super::schedule::Schedule;
use super::{Drawn, added};

/// Free clearance: d = tau / k + b sgn(tau), in a third of the cases with the contact's compliance
/// as b u / sqrt(u^2 + w^2) (deadband: Nordin and Gutman, 2002).
pub fn backlash(schedule: &Schedule, random: &mut Random) -> Drawn {
    let width = if random.chance(0.35) {
        random.log_uniform(0.004, 0.03)
    } else {
        0.0
    };
    let step = |u: f64| if u == 0.0 { 0.0 } else { u / u.hypot(width) };
    let shape = schedule.load.iter().map(|&u| step(u)).collect();
    added(shape, 0.3, "half_gap_rad", vec![("rounding_of_max", width)])
}

/// Lower stiffness inside |tau| < tau0: adds a clip(u / u0), in half of the cases with hyperbolic
/// corners (|u + u0| - |u - u0|) / 2 (stiffness stages of strain-wave gears: Tuttle, 1992).
pub fn soft_zone(schedule: &Schedule, random: &mut Random) -> Drawn {
    let edge = random.uniform(0.15, 0.55);
    let round = if random.chance(0.5) {
        edge * random.uniform(0.03, 0.2)
    } else {
        0.0
    };
    let clip = |u: f64| ((u + edge).hypot(round) - (u - edge).hypot(round)) / (2.0 * edge);
    let shape = schedule.load.iter().map(|&u| clip(u)).collect();
    let parameters = vec![("edge_of_max", edge), ("rounding_of_max", round)];
    added(shape, (4.0 * edge).min(0.8), "extra_rad", parameters)
}

/// Different stiffness in tension and compression: adds c |u|, in half of the cases with a smooth
/// change sqrt(u^2 + w^2) - w (bilinear oscillator: Shaw and Holmes, 1983).
pub fn asymmetry(schedule: &Schedule, random: &mut Random) -> Drawn {
    let width = if random.chance(0.5) {
        random.log_uniform(0.005, 0.05)
    } else {
        0.0
    };
    let sign = random.sign();
    let fold = |u: f64| sign * (u.hypot(width) - width);
    let shape = schedule.load.iter().map(|&u| fold(u)).collect();
    let parameters = vec![("sign", sign), ("rounding_of_max", width)];
    added(shape, 0.35, "at_full_load_rad", parameters)
}
