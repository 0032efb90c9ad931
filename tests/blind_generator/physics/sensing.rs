//! Effects of the measuring chain: offset, drift, skew, saturation.

use super::super::line::{Line, bisect, peak};
use super::super::random::Random;
use super::super::schedule::Schedule;
use super::{Drawn, Law, added};

/// A reading that was never set to zero: a constant from the first row on.
pub fn offset(schedule: &Schedule, random: &mut Random) -> Drawn {
    let shape = vec![random.sign(); schedule.load.len()];
    slope_only(added(shape, 0.3, "offset_rad", Vec::new()))
}

/// Warm-up 1 - exp(-t / T) (lumped thermal mass: Newton, 1701), from quick to nearly linear in time.
pub fn drift(schedule: &Schedule, random: &mut Random) -> Drawn {
    let end = schedule.duration();
    let constant = end * random.log_uniform(0.2, 5.0);
    let sign = random.sign() / (1.0 - (-end / constant).exp());
    let warm = |t: &f64| sign * (1.0 - (-t / constant).exp());
    let shape = schedule.time.iter().map(warm).collect();
    let parameters = vec![("time_constant_s", constant)];
    slope_only(added(shape, 0.3, "drift_at_end_rad", parameters))
}

/// The constant counts as part of the effect.
fn slope_only(mut drawn: Drawn) -> Drawn {
    if let Law::Added { line, .. } = &mut drawn.law {
        *line = Line::SlopeOnly;
    }
    drawn
}

/// Peak beyond the line of a plain spring read late: y(t) = d(t - delay).
pub fn skew_size(schedule: &Schedule, delay: f64) -> f64 {
    let load = schedule.sampled(&schedule.load);
    let late = schedule.sampled_late(&schedule.load, delay);
    peak(&late, &load, Line::Full)
}

/// The delay (negative: early) that gives the wanted peak.
pub fn skew_for(schedule: &Schedule, early: bool, longest: f64, wanted: f64) -> f64 {
    let end = if early { -longest } else { longest };
    end * bisect(0.0, 1.0, wanted, |share| skew_size(schedule, end * share))
}

/// A load cell that stops at `level`, on the (upper, lower) side.
pub fn saturate(load: &[f64], level: f64, sides: (bool, bool)) -> Vec<f64> {
    let high = if sides.0 { level } else { f64::INFINITY };
    let low = if sides.1 { -level } else { f64::NEG_INFINITY };
    load.iter().map(|u| u.clamp(low, high)).collect()
}

/// Peak beyond the line of a plain spring over the reported load.
pub fn saturation_size(load: &[f64], level: f64, sides: (bool, bool)) -> f64 {
    peak(load, &saturate(load, level, sides), Line::Full)
}

/// The level that gives the wanted peak.
pub fn saturation_for(load: &[f64], sides: (bool, bool), wanted: f64) -> f64 {
    let size = |below: f64| saturation_size(load, 1.0 - below, sides);
    1.0 - bisect(0.0, 0.2, wanted, size)
}
