//! How a laboratory hits: sampling, records, pulses, and what its instruments are worth.

use super::super::algebra::V3;
use super::super::{chance, pick};
use ident::ground::random::Random;
use std::f64::consts::{PI, TAU};

/// One hit on the fine raster.
#[derive(Debug, Clone)]
pub struct Hit {
    pub direction: usize,
    pub number: usize,
    /// First fine step of the pulse and its forces, N.
    pub start: usize,
    pub pulse: Vec<f64>,
    /// Where it strikes beside the aim, in standard deviations.
    pub place: V3,
    /// When a cable strikes back (s after the hit) and along what.
    pub back: (f64, V3),
}

/// A day in the laboratory.
#[derive(Debug, Clone)]
pub struct Habit {
    pub interval: f64,
    /// Fine steps per sample.
    pub fine: usize,
    pub samples: usize,
    pub pretrigger: f64,
    pub hits: Vec<Hit>,
    /// Measured responses.
    pub responses: Vec<usize>,
    /// Time constant of a window that the file declares, s.
    pub window: Option<f64>,
    pub noise: Noise,
    pub shape: &'static str,
    pub told_noise: bool,
}

/// Scatter of the channels.
#[derive(Debug, Clone, Copy)]
pub struct Noise {
    /// White, m/s² and N.
    pub white: f64,
    pub force: f64,
    /// Rms of what grows towards low frequency, share of the white, and its corner, Hz.
    pub slow: f64,
    pub corner: f64,
    /// Mains, m/s² and Hz.
    pub hum: f64,
    /// Steps of the converter, m/s² and N.
    pub step: f64,
    pub force_step: f64,
}

impl Noise {
    fn draw(random: &mut Random) -> Self {
        let white = random.log_uniform(0.003, 0.05);
        Self {
            white,
            force: random.log_uniform(0.05, 0.6),
            slow: if chance(random, 0.5) {
                random.uniform(0.15, 0.8)
            } else {
                0.0
            },
            corner: random.log_uniform(0.5, 3.0),
            hum: if chance(random, 0.3) {
                white * random.uniform(0.3, 1.5)
            } else {
                0.0
            },
            step: *pick(random, &[1e-4, 5e-4, 0.002]),
            force_step: *pick(random, &[0.01, 0.05]),
        }
    }

    /// Variance of a reading at a frequency, as white noise of that density would have.
    pub fn power(&self, frequency: f64, interval: f64) -> f64 {
        let pole = (-TAU * self.corner * interval).exp();
        let turn = nalgebra::Complex::new(0.0, -TAU * frequency * interval).exp();
        let low = (1.0 - pole * pole) / (-turn * pole + 1.0).norm_sqr();
        let counted = self.step.powi(2) / 12.0;
        self.white.powi(2) * (1.0 + self.slow.powi(2) * low) + counted
    }
}

/// The pulse of a hammer, its top at one.
fn pulse(shape: &str, at: f64, second: (f64, f64)) -> f64 {
    let half = |x: f64| {
        if (0.0..1.0).contains(&x) {
            (PI * x).sin()
        } else {
            0.0
        }
    };
    match shape {
        "half sine" => half(at),
        "haversine" => half(at).powi(2),
        "skew" => half(at.clamp(0.0, 1.0).powf(0.75)),
        _ => half(at / 0.7) + second.1 * half((at - second.0) / 0.6),
    }
}

impl Habit {
    /// Records long enough for motions that decay this slowly (1/s), or windowed.
    pub fn draw(random: &mut Random, decay: f64) -> Self {
        let rate: f64 = *pick(random, &[800.0, 1000.0, 1000.0, 1024.0, 1280.0, 2000.0]);
        let enough = 8.5 / decay;
        let longest = if rate > 1500.0 { 2.5 } else { 4.0 };
        let length = f64::min(enough * random.uniform(1.0, 1.3), longest).max(1.0);
        let missing = 8.0 - decay * length;
        let window = match missing > 0.3 {
            true => Some(length / (missing + random.uniform(0.0, 1.0))),
            false => chance(random, 0.25).then(|| length / random.uniform(1.0, 3.0)),
        };
        let mut own = Self {
            interval: 1.0 / rate,
            fine: (4000.0 / rate).ceil() as usize,
            samples: (length * rate) as usize,
            pretrigger: *pick(random, &[0.02, 0.03, 0.05, 0.1]),
            hits: Vec::new(),
            responses: responses(random),
            window: window.map(|t| (t * 1e4).round() / 1e4),
            noise: Noise::draw(random),
            shape: pick::<&'static str>(random, &["half sine", "haversine", "skew", "two peaks"]),
            told_noise: chance(random, 0.6),
        };
        own.strike(random);
        own
    }

    /// A fine step, s.
    pub fn step(&self) -> f64 {
        self.interval / self.fine as f64
    }

    fn strike(&mut self, random: &mut Random) {
        let directions: &[usize] = match random.below(6) {
            0 => &[0, 2],
            1 => &[1, 2],
            _ => &[0, 1, 2],
        };
        let count = 3 + random.below(6);
        let (peak, width) = (random.uniform(180.0, 550.0), random.uniform(0.004, 0.010));
        let spread = random.uniform(0.05, 0.3);
        let second = (random.uniform(0.3, 0.4), random.uniform(0.5, 0.9));
        for direction in directions {
            for number in 1..=count {
                let peak = peak * (1.0 + spread * random.uniform(-1.0, 1.0));
                let steps = width * random.uniform(0.9, 1.1) / self.step();
                let of = |i: usize| peak * pulse(self.shape, i as f64 / steps, second);
                let late = self.pretrigger + random.uniform(0.0, 0.5) * self.interval;
                self.hits.push(Hit {
                    direction: *direction,
                    number,
                    start: (late / self.step()) as usize,
                    pulse: (0..=steps.ceil() as usize).map(of).collect(),
                    place: std::array::from_fn(|_| random.normal()),
                    back: (
                        random.uniform(0.08, 0.5),
                        std::array::from_fn(|_| random.normal()),
                    ),
                });
            }
        }
    }

    /// Directions that were hit.
    pub fn directions(&self) -> Vec<usize> {
        let mut all: Vec<usize> = self.hits.iter().map(|h| h.direction).collect();
        all.dedup();
        all
    }
}

fn responses(random: &mut Random) -> Vec<usize> {
    match random.below(8) {
        0 => vec![0, 2],
        1 => vec![2, 1],
        _ => vec![0, 1, 2],
    }
}
