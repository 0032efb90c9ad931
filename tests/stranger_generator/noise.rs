//! Noise that nobody announced, of unit size in the typical reading.

use super::one;
use super::schedule::Schedule;
use ident::ground::random::Random;
use std::f64::consts::TAU;

const NAMES: &[&str] = &[
    "white",
    "white",
    "correlated",
    "flicker",
    "with load",
    "bursts",
    "mains",
];

/// A kind of noise with its realisation at the rows.
pub fn draw(schedule: &Schedule, random: &mut Random) -> (&'static str, Vec<f64>) {
    let name = one(random, NAMES);
    let n = schedule.rows();
    let mut white: Vec<f64> = (0..n).map(|_| random.normal()).collect();
    let load = schedule.sampled(&schedule.load);
    match name {
        "correlated" => {
            let rho = random.uniform(0.3, 0.85);
            for i in 1..n {
                white[i] = rho * white[i - 1] + (1.0 - rho * rho).sqrt() * white[i];
            }
        }
        "flicker" => white = flicker(white, random),
        "with load" => {
            let grows = random.uniform(1.0, 4.0);
            let factors = load
                .iter()
                .map(|u| (1.0 + grows * u.abs()) / (1.0 + 0.5 * grows));
            white.iter_mut().zip(factors).for_each(|(w, f)| *w *= f);
        }
        "bursts" => {
            for _ in 0..1 + random.below(3) {
                let (from, long) = (random.below(n), 1 + n / 40 + random.below(1 + n / 25));
                let more = random.uniform(2.0, 5.0);
                let own = white.iter_mut().skip(from).take(long);
                own.for_each(|w| *w *= more);
            }
        }
        "mains" => {
            // folded by the sampling to anywhere in the upper band
            let (cycles, size) = (random.uniform(0.08, 0.45), random.uniform(0.5, 1.5));
            let own = white.iter_mut().enumerate();
            own.for_each(|(i, w)| *w = 0.7 * *w + size * (TAU * cycles * i as f64).sin());
        }
        _ => {}
    }
    (name, white)
}

/// White noise and a sum of relaxations of many times beside it: nearly 1/f.
fn flicker(white: Vec<f64>, random: &mut Random) -> Vec<f64> {
    let mut states = [0.0_f64; 6];
    let share = random.uniform(0.2, 0.45);
    let each = white.into_iter().map(|w| {
        for (k, state) in states.iter_mut().enumerate() {
            let keep = 1.0 - 0.5_f64.powi(k as i32 + 1);
            *state = keep * *state + (1.0 - keep * keep).sqrt() * random.normal();
        }
        0.8 * w + share * states.iter().sum::<f64>()
    });
    each.collect()
}
