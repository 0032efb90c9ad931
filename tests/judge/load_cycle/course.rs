//! What happens to a reading by and by: warmth, slips, zeros; and how the two channels lie in time.

use super::super::chance;
use super::memory::{lag, sign};
use super::programme::Programme;
use ident::ground::random::Random;
use std::f64::consts::TAU;

/// Warmth of the hall, of the motor, of the sun.
pub fn drift(p: &Programme, random: &mut Random) -> (Vec<f64>, &'static str) {
    match random.below(4) {
        0 => {
            let tau = random.uniform(0.2, 1.5);
            (p.of_time(|t| 1.0 - (-t / tau).exp()), "exponential")
        }
        1 => {
            let (rate, phase) = (TAU / random.uniform(0.9, 3.0), random.uniform(0.0, TAU));
            (
                p.of_time(|t| (rate * t + phase).sin() - phase.sin()),
                "sine of the room",
            )
        }
        2 => (p.of_time(f64::sqrt), "diffusion"),
        _ => {
            let bow = random.uniform(-0.6, 0.6);
            (p.of_time(|t| t + bow * t * t), "steady")
        }
    }
}

/// The stand of the sensor, or the clamp, moves once or twice.
pub fn slip(p: &Programme, random: &mut Random) -> (Vec<f64>, &'static str) {
    let first = random.uniform(0.15, 0.85);
    match random.below(4) {
        0 => (
            p.of_time(|t| f64::from(u8::from(t > first))),
            "at an instant",
        ),
        1 => {
            let level = random.uniform(0.7, 0.95);
            let at = p.u.iter().position(|u| u.abs() > level).unwrap_or(0);
            let way = p.u[at].signum();
            (
                (0..p.u.len())
                    .map(|i| if i >= at { way } else { 0.0 })
                    .collect(),
                "at a load",
            )
        }
        2 => {
            let (second, share) = (random.uniform(0.15, 0.85), random.uniform(0.4, 1.0));
            let on = |t: f64, at: f64| f64::from(u8::from(t > at));
            (p.of_time(|t| on(t, first) + share * on(t, second)), "twice")
        }
        _ => {
            let slow = random.uniform(0.002, 0.01);
            (
                p.of_time(|t| ((t - first) / slow).clamp(0.0, 1.0)),
                "slides for a moment",
            )
        }
    }
}

/// The zero of the sensor.
pub fn offset(p: &Programme, _: &mut Random) -> (Vec<f64>, &'static str) {
    (vec![1.0; p.u.len()], "zero")
}

/// What channels that do not lie together in time change, for a size of the delay from 0 to 1.
pub fn skew(p: &Programme, form: usize, early: bool, size: f64) -> Vec<f64> {
    let delay = size * 0.03 * p.last();
    let late = match form {
        0 => p.before(delay),
        1 => lag(p, delay),
        _ => {
            let far = p.before(delay);
            let near = &p.u;
            let share = p.of_time(|t| 0.3 + 0.7 * t);
            (0..near.len())
                .map(|i| near[i] + share[i] * (far[i] - near[i]))
                .collect()
        }
    };
    let way = if early { -1.0 } else { 1.0 };
    late.iter().zip(&p.u).map(|(l, u)| way * (l - u)).collect()
}

/// Shapes that no effect of the contract makes.
pub fn outside(name: &str, p: &Programme, random: &mut Random) -> Vec<f64> {
    let phase = random.uniform(0.0, TAU);
    match name {
        "tooth mesh over load" => {
            // Six readings a wave at least: else it is scatter to anybody.
            let most = (1.0 / (6.0 * pace(p))).min(6.0);
            let waves = most * random.uniform(0.5, 1.0);
            p.of_load(|u| (TAU * waves * u + phase).sin() - phase.sin())
        }
        "catch on one branch" => {
            // Something hooks in at one load, on the way up only, and lets go again.
            let (at, wide) = (random.uniform(0.2, 0.7), random.uniform(0.06, 0.15));
            let up = (0..p.u.len()).map(|i| i > 0 && p.u[i] > p.u[i - 1]);
            let bell = p.of_load(|u| (-((u - at) / wide).powi(2)).exp());
            bell.iter()
                .zip(up)
                .map(|(b, up)| if up { *b } else { 0.0 })
                .collect()
        }
        "neighbouring press" => {
            let period = random.uniform(0.06, 0.12);
            p.of_time(|t| f64::from(u8::from((t / period + 0.3).fract() < 0.35)))
        }
        "telegraph" => {
            let mut at = Vec::new();
            let mut t = 0.0;
            while t < 1.0 {
                t += random.uniform(0.02, 0.09);
                at.push(t);
            }
            p.of_time(|t| f64::from(u8::from(at.partition_point(|a| *a < t) % 2 == 1)))
        }
        "wave of the foundation" => {
            let rate = TAU * random.uniform(5.3, 11.7);
            p.of_time(|t| (rate * t + phase).sin() - phase.sin() * (-20.0 * t).exp())
        }
        _ => {
            // A loop whose sense changes with the sign of the load, twice: lagging below half load, leading above.
            let slow = lag(p, 0.01 * p.last());
            let s = sign(random);
            (0..p.u.len())
                .map(|i| s * (slow[i] - p.u[i]) * (TAU * 1.5 * p.u[i].abs()).cos())
                .collect()
        }
    }
}

/// How far the load goes between two readings while it moves, the faster half.
fn pace(p: &Programme) -> f64 {
    let u = p.read(&p.u);
    let steps = u.windows(2).map(|w| (w[1] - w[0]).abs());
    let mut moving: Vec<f64> = steps.filter(|d| *d > 1e-6).collect();
    moving.sort_by(f64::total_cmp);
    moving[moving.len() * 3 / 4]
}

/// Whether a programme could show a shape from outside at all.
pub fn shows(name: &str, p: &Programme) -> bool {
    match name {
        // What is spread over a few readings is a handful of outliers to anybody.
        "catch on one branch" | "crossed loop" => !p.standing && pace(p) < 0.025,
        "tooth mesh over load" => !p.standing && pace(p) < 0.04,
        _ => p.rows.len() >= 150 && !p.standing,
    }
}

/// Early or late.
pub fn early(random: &mut Random) -> bool {
    chance(random, 0.3)
}
