//! What strangers do with a press: sines, triangles, ramps, dead weights, one side only, one cycle only.

use super::one;
use ident::ground::random::Random;
use std::f64::consts::{PI, TAU};

/// A load over time on a fine grid, of which every `stride`-th point is a row.
pub struct Schedule {
    /// Its name.
    pub name: &'static str,
    /// Time, s.
    pub time: Vec<f64>,
    /// Load over the largest.
    pub load: Vec<f64>,
    /// Fine points per row.
    pub stride: usize,
    /// Whether the load takes both signs.
    pub two_sided: bool,
    /// Cycles.
    pub cycles: usize,
}

const NAMES: &[&str] = &[
    "sine",
    "triangle",
    "growing sine",
    "dead weights",
    "one-sided",
    "one-sided sine",
    "single",
    "ramps with dwells",
    "two speeds",
];

impl Schedule {
    /// Any of them.
    pub fn draw(random: &mut Random) -> Self {
        let name = one(random, NAMES);
        let cycles = match name {
            "single" => 1,
            "dead weights" => 1 + random.below(2),
            _ => 2 + random.below(4),
        };
        let rows = match random.unit() {
            x if x < 0.12 => random.log_uniform(25.0, 120.0),
            x if x < 0.92 => random.log_uniform(150.0, 2500.0),
            _ => random.log_uniform(2500.0, 20_000.0),
        } as usize;
        let rows = rows.max(12 * cycles);
        let stride = 5000_usize.div_ceil(rows).max(2);
        let points = rows * stride;
        let period = random.log_uniform(3.0, 60.0);
        let rest = match random.unit() < 0.5 {
            true => random.uniform(0.02, 0.1),
            false => 0.0,
        };
        let steps = 4 + random.below(5);
        let fast = random.uniform(2.0, 5.0);
        let total = (cycles as f64 + rest) * period;
        let time: Vec<f64> = (0..points)
            .map(|i| total * i as f64 / (points - 1) as f64)
            .collect();
        let sign = if random.unit() < 0.5 { 1.0 } else { -1.0 };
        let at = |t: f64| {
            let c = t / period - rest;
            match c <= 0.0 {
                true => 0.0,
                false => sign * shape(name, c, cycles as f64, steps, fast),
            }
        };
        Self {
            load: time.iter().map(|t| at(*t)).collect(),
            name,
            time,
            stride,
            two_sided: !(name.starts_with("one") || name == "dead weights"),
            cycles,
        }
    }

    /// Whether an effect can show under this load at all.
    pub fn shows(&self, effect: &str) -> bool {
        let few = self.rows() < 60;
        match effect {
            "asymmetry" | "backlash" => self.two_sided && !few,
            "time_skew" => self.name != "dead weights" && !few,
            "loosening" => self.cycles >= 3 && !few,
            "slip" => !few,
            "creep" => self.cycles >= 2 || self.name == "dead weights",
            "thermal_drift" => self.cycles >= 2,
            "hysteresis" | "coulomb_friction" => !few && self.name != "dead weights",
            "quantization" => self.rows() > 150 && self.name != "dead weights",
            outside if outside.starts_with("outside") => {
                self.rows() > 200 && self.name != "dead weights" && self.cycles > 1
            }
            _ => true,
        }
    }

    /// Rows.
    pub fn rows(&self) -> usize {
        self.time.len() / self.stride
    }

    /// A quantity of the fine grid at the rows.
    pub fn sampled(&self, fine: &[f64]) -> Vec<f64> {
        (0..self.rows()).map(|i| fine[i * self.stride]).collect()
    }

    /// Whole duration, s.
    pub fn duration(&self) -> f64 {
        self.time[self.time.len() - 1]
    }
}

fn triangle(c: f64) -> f64 {
    let x = c.rem_euclid(1.0);
    match x {
        x if x < 0.25 => 4.0 * x,
        x if x < 0.75 => 2.0 - 4.0 * x,
        x => 4.0 * x - 4.0,
    }
}

fn one_sided(c: f64) -> f64 {
    1.0 - (2.0 * c.rem_euclid(1.0) - 1.0).abs()
}

fn shape(name: &str, c: f64, cycles: f64, steps: usize, fast: f64) -> f64 {
    match name {
        "sine" => (TAU * c).sin(),
        "growing sine" => (0.3 + 0.7 * (c.floor() / (cycles - 1.0)).min(1.0)) * (TAU * c).sin(),
        "dead weights" => {
            (one_sided(c) * steps as f64 + 0.5)
                .floor()
                .min(steps as f64)
                / steps as f64
        }
        "one-sided" => one_sided(c),
        "one-sided sine" => 0.5 - 0.5 * (TAU * c).cos(),
        "ramps with dwells" => (1.6 * triangle(c)).clamp(-1.0, 1.0),
        "two speeds" => {
            let half = 0.5 * cycles;
            // slow in the first half of the record, `fast` times as fast in whole cycles after it
            let warped = match c < half.floor().max(1.0) {
                true => c,
                false => half.floor().max(1.0) + fast.floor() * (c - half.floor().max(1.0)),
            };
            triangle(warped)
        }
        "single" => 0.5 * PI.sin() + triangle(c),
        _ => triangle(c),
    }
}
