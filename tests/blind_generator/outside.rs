//! Effects that the library does not hold and that none of its families can imitate.

use super::physics::{Drawn, Law, added};
use super::random::Random;
use super::schedule::Schedule;
use std::f64::consts::TAU;

/// Names of the unknown effects.
pub const OUTSIDE: &[&str] = &[
    "outside:gear_ripple",
    "outside:hum",
    "outside:bump",
    "outside:saturation",
    "outside:rate_square",
    "outside:dropouts",
    "outside:chirp",
    "outside:sawtooth",
];

/// The schedules on which an unknown effect cannot pass for a known one; `None`: any. A term in the
/// rate of load needs a load whose rate changes within every branch; a load cell that stops needs
/// every cycle to go beyond its level and no dwell there (with one, a steep power law would do).
pub fn schedule_for(kind: &str, random: &mut Random) -> Option<&'static str> {
    match kind {
        "outside:rate_square" => Some(random.choose(&["hand-pumped", "hand-pumped-growing"])),
        "outside:saturation" => Some(random.choose(&["triangle", "sine", "two-rates"])),
        _ => None,
    }
}

/// At most this many waves over the load range, so that each has half a dozen rows.
fn most_waves(schedule: &Schedule, wanted: f64) -> f64 {
    let rows_a_cycle = schedule.rows() as f64 * schedule.period / schedule.duration();
    (rows_a_cycle / 12.0).clamp(4.5, wanted)
}

/// Draws the law of a named unknown effect; `None` if there is no such one.
pub fn draw(kind: &str, schedule: &Schedule, random: &mut Random) -> Option<Drawn> {
    Some(match kind {
        "outside:gear_ripple" => gear_ripple(schedule, random),
        "outside:hum" => hum(schedule, random),
        "outside:bump" => bump(schedule, random),
        "outside:saturation" => Drawn {
            law: Law::Saturation {
                sides: random.choose(&[(true, true), (true, false), (false, true)]),
            },
            parameters: Vec::new(),
        },
        "outside:rate_square" => rate_square(schedule),
        "outside:dropouts" => dropouts(schedule, random),
        "outside:chirp" => chirp(schedule, random),
        "outside:sawtooth" => sawtooth(schedule, random),
        _ => return None,
    })
}

fn over_load(schedule: &Schedule, f: impl Fn(f64) -> f64) -> Vec<f64> {
    let zero = f(0.0);
    schedule.load.iter().map(|&u| f(u) - zero).collect()
}

fn over_time(schedule: &Schedule, f: impl Fn(f64) -> f64) -> Vec<f64> {
    let zero = f(0.0);
    schedule.time.iter().map(|&t| f(t) - zero).collect()
}

/// Tooth mesh: sin(pi n u + phase), n waves over the whole load range (Tuttle and Seering, 1996).
fn gear_ripple(schedule: &Schedule, random: &mut Random) -> Drawn {
    let (waves, phase) = (
        random.uniform(4.0, most_waves(schedule, 10.0)),
        random.uniform(0.0, TAU),
    );
    let shape = over_load(schedule, |u| (0.5 * TAU * waves * u + phase).sin());
    added(shape, 0.2, "ripple_rad", vec![("waves_over_range", waves)])
}

/// A sawtooth in load: creeping up a pawl and snapping back.
fn sawtooth(schedule: &Schedule, random: &mut Random) -> Drawn {
    let (teeth, phase) = (
        random.uniform(4.0, most_waves(schedule, 8.0)),
        random.unit(),
    );
    let shape = over_load(schedule, |u| (0.5 * teeth * u + phase).rem_euclid(1.0));
    added(shape, 0.2, "tooth_rad", vec![("teeth_over_range", teeth)])
}

/// Lowest and highest frequency between the load cycle and the sampling rate, Hz.
fn band(schedule: &Schedule) -> (f64, f64) {
    let sampling = (schedule.rows() - 1) as f64 / schedule.duration();
    let low = 5.0 / schedule.period;
    (low, (sampling / 8.0).max(1.2 * low))
}

/// A machine next door: sin(2 pi f t + phase), several periods a cycle, several rows a period.
fn hum(schedule: &Schedule, random: &mut Random) -> Drawn {
    let (low, high) = band(schedule);
    let (frequency, phase) = (random.log_uniform(low, high), random.uniform(0.0, TAU));
    let shape = over_time(schedule, |t| (TAU * frequency * t + phase).sin());
    added(shape, 0.2, "hum_rad", vec![("frequency_Hz", frequency)])
}

/// A run-up of a spindle: frequency rising linearly through the same band.
fn chirp(schedule: &Schedule, random: &mut Random) -> Drawn {
    let (low, high) = band(schedule);
    let rate = (high - low) / schedule.duration();
    let phase = random.uniform(0.0, TAU);
    let shape = over_time(schedule, |t| {
        (TAU * (low + 0.5 * rate * t) * t + phase).sin()
    });
    let parameters = vec![("from_Hz", low), ("to_Hz", high)];
    added(shape, 0.2, "chirp_rad", parameters)
}

/// A dent in a bearing race: a Gaussian bump at one load.
fn bump(schedule: &Schedule, random: &mut Random) -> Drawn {
    let centre = random.sign() * random.uniform(0.3, 0.75);
    let width = random.uniform(0.04, 0.09);
    let sign = random.sign();
    let shape = over_load(schedule, |u| {
        sign * (-0.5 * ((u - centre) / width).powi(2)).exp()
    });
    let parameters = vec![("centre_of_max", centre), ("width_of_max", width)];
    added(shape, 0.3, "bump_rad", parameters)
}

/// A film that is sheared thick: (du/dt)^2, the same for both directions.
fn rate_square(schedule: &Schedule) -> Drawn {
    let last = schedule.load.len() - 1;
    let rate = |i: usize| {
        let (a, b) = (i.saturating_sub(1), (i + 1).min(last));
        (schedule.load[b] - schedule.load[a]) / (schedule.time[b] - schedule.time[a])
    };
    let shape = (0..=last).map(|i| rate(i).powi(2)).collect();
    added(
        super::physics::to_unit_peak(shape),
        0.3,
        "peak_rad",
        Vec::new(),
    )
}

/// A loose plug: in a few bursts the reading jumps away and back at random.
fn dropouts(schedule: &Schedule, random: &mut Random) -> Drawn {
    let rows = schedule.rows();
    let mut gate = vec![0.0; rows];
    let bursts = random.integer(4, 8);
    for burst in 0..bursts {
        let length = random.integer(rows / 50 + 4, rows / 25 + 6);
        let slot = rows / bursts;
        let start = burst * slot + random.integer(0, slot.saturating_sub(length + 1));
        let end = (start + length).min(rows);
        let mut away = true;
        for value in &mut gate[start..end] {
            *value = f64::from(u8::from(away));
            away ^= random.chance(0.35);
        }
    }
    let sign = random.sign();
    let at = |i: usize| sign * gate[(i / schedule.stride).min(rows - 1)];
    let shape = (0..schedule.load.len()).map(at).collect();
    added(shape, 0.3, "jump_rad", vec![("bursts", bursts as f64)])
}
