//! Noise of readings; everything in parts of the deflection under the largest load.

use super::super::{chance, pick};
use super::programme::Programme;
use ident::ground::random::Random;
use std::f64::consts::TAU;

/// Law of the noise of one file.
#[derive(Debug, Clone)]
pub struct Noise {
    /// Deviation of a reading of the whole, rms over the file.
    pub base: f64,
    /// Deviation of every reading over `base`.
    sd: Vec<f64>,
    /// Correlation of neighbours.
    phi: f64,
    /// Mains: turns per reading.
    line: Option<f64>,
    tail: bool,
    /// Part of the whole that the load cell makes.
    pub cell: f64,
    /// Raster of the readings over `base`; far below one.
    pub raster: f64,
    /// Drift that is below what matters, over `base` at the end.
    creeping: f64,
    pub name: String,
}

fn shape(law: &str, p: &Programme, random: &mut Random) -> Vec<f64> {
    let at: Vec<f64> = match law {
        "by load" => p.u.iter().map(|u| 0.4 + 1.8 * u.abs()).collect(),
        "bursts" => {
            let from: Vec<f64> = (0..3).map(|_| random.uniform(0.0, 0.95)).collect();
            p.of_time(|t| {
                if from.iter().any(|f| (*f..f + 0.04).contains(&t)) {
                    4.0
                } else {
                    1.0
                }
            })
        }
        _ => vec![1.0; p.u.len()],
    };
    let own = p.read(&at);
    let rms = (own.iter().map(|x| x * x).sum::<f64>() / own.len() as f64).sqrt();
    own.iter().map(|x| x / rms).collect()
}

impl Noise {
    /// One by chance.
    pub fn draw(p: &Programme, random: &mut Random) -> Self {
        let many = p.rows.len() >= 200 && !p.standing;
        let laws: &[&str] = if many && p.even {
            &[
                "white",
                "white",
                "coloured",
                "by load",
                "bursts",
                "mains",
                "noisy cell",
                "drifting a little",
                "rounded",
                "tails",
            ]
        } else {
            &[
                "white",
                "white",
                "by load",
                "noisy cell",
                "drifting a little",
                "rounded",
                "tails",
            ]
        };
        let law = *pick(random, laws);
        let phi = random.uniform(0.5, 0.9);
        Self {
            base: random.log_uniform(6e-4, 6e-3),
            sd: shape(law, p, random),
            phi: if law == "coloured" { phi } else { 0.0 },
            line: (law == "mains").then(|| random.uniform(0.08, 0.46)),
            tail: law == "tails",
            // Weights have none; a command that was written down instead of the load neither.
            cell: match law {
                "noisy cell" => 0.8,
                _ if p.standing || chance(random, 0.25) => 0.0,
                _ => 0.2,
            },
            raster: if law == "rounded" { 0.8 } else { 0.02 },
            creeping: if law == "drifting a little" { 0.4 } else { 0.0 },
            name: if phi > 0.0 && law == "coloured" {
                format!("coloured {phi:.2}")
            } else {
                law.into()
            },
        }
    }

    /// A column in units of independent readings.
    pub fn white(&self, column: &[f64]) -> Vec<f64> {
        let own: Vec<f64> = column
            .iter()
            .zip(&self.sd)
            .map(|(c, s)| c / s / self.base)
            .collect();
        let rest = (1.0 - self.phi * self.phi).sqrt();
        (0..own.len())
            .map(|i| {
                if i == 0 {
                    own[0]
                } else {
                    (own[i] - self.phi * own[i - 1]) / rest
                }
            })
            .collect()
    }

    /// Columns of what is no effect, and free.
    pub fn known(&self, p: &Programme) -> Vec<Vec<f64>> {
        let mut all = Vec::new();
        if let Some(rate) = self.line {
            let wave = |quarter: f64| {
                (0..self.sd.len())
                    .map(|i| (TAU * rate * i as f64 + quarter).sin())
                    .collect()
            };
            all.extend([wave(0.0), wave(0.25 * TAU)]);
        }
        if self.creeping > 0.0 {
            all.push(p.read(&p.t));
        }
        all
    }

    fn one(&self, random: &mut Random) -> f64 {
        let wide = random.normal();
        if !self.tail {
            return wide;
        }
        // Student with five degrees of freedom, of variance one.
        let chi: f64 = (0..5).map(|_| random.normal().powi(2)).sum();
        wide / (chi / 5.0).sqrt() / (5.0_f64 / 3.0).sqrt()
    }

    /// Errors of the readings of one sensor.
    pub fn sample(&self, random: &mut Random) -> Vec<f64> {
        let share = (1.0 - self.cell * self.cell).sqrt();
        let (lines, phase) = (
            if self.line.is_some() { 0.7 } else { 0.0 },
            random.uniform(0.0, TAU),
        );
        let own = (1.0_f64 - lines * lines).sqrt();
        let sign = if chance(random, 0.5) { 1.0 } else { -1.0 };
        let mut z = self.one(random);
        let mut all = Vec::new();
        for (i, sd) in self.sd.iter().enumerate() {
            if i > 0 {
                z = self.phi * z + (1.0 - self.phi * self.phi).sqrt() * self.one(random);
            }
            let wave =
                2.0_f64.sqrt() * lines * (TAU * self.line.unwrap_or(0.0) * i as f64 + phase).sin();
            let grown = sign * self.creeping * i as f64 / self.sd.len() as f64;
            all.push(self.base * (share * sd * (own * z + wave) + grown));
        }
        all
    }

    /// Errors of the load cell.
    pub fn of_cell(&self, random: &mut Random) -> Vec<f64> {
        self.sd
            .iter()
            .map(|_| self.cell * self.base * random.normal())
            .collect()
    }
}
