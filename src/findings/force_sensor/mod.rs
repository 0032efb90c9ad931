//! What is wrong with a force sensor or its load: readings of a sensor that touches nothing, less what the
//! nominal tool makes.

mod base_tilt;
mod centre_of_mass;
mod cross_talk;
mod experiment;
mod force_gain;
mod hose_force;
mod outlier_point;
mod sensor_offset;
mod sensor_rotation;
mod thermal_drift;
mod tool_weight;

use super::table::Effect;
use crate::fit::force_sensor::statics::{N, reading, slopes};
use crate::fit::force_sensor::{Account, identify};
use crate::ground::problem::Outcome;
use crate::measurement::force_sensor::SensorTest;

/// Every effect of this kind.
pub const EFFECTS: &[Effect<Case>] = &[
    tool_weight::EFFECT,
    centre_of_mass::EFFECT,
    sensor_offset::EFFECT,
    sensor_rotation::EFFECT,
    base_tilt::EFFECT,
    force_gain::EFFECT,
    cross_talk::EFFECT,
    hose_force::EFFECT,
    thermal_drift::EFFECT,
    outlier_point::EFFECT,
];

/// A sensor test as its diagnosis sees it: six rows per reading, moments over a length, so that all are N.
pub struct Case {
    /// The file.
    pub test: SensorTest,
    /// The simulation: nominal weight and centre, no offset, no turn, no tilt. Without a nominal weight that
    /// of a fit, which then cannot be blamed.
    pub nominal: [f64; N],
    /// Whether the file states weight and centre.
    pub stated: [bool; 2],
    /// Slopes of every reading's six channels along the parameters.
    pub slopes: Vec<[[f64; N]; 6]>,
    /// What the simulation says, row by row, N.
    pub simulated: Vec<f64>,
    /// Measured less simulated, N.
    pub missed: Vec<f64>,
    /// Noise of a row, N, and the rows it is worth.
    pub noise: (f64, f64),
    /// Length by which moments are divided, m.
    pub arm: f64,
    /// Point of every reading, from 0, and their names.
    pub points: (Vec<usize>, Vec<i64>),
    /// Time of every reading, else its place in the order, 0 to 1.
    pub progress: Vec<f64>,
}

impl Case {
    /// Of a file.
    ///
    /// # Errors
    /// A single orientation.
    pub fn new(test: SensorTest) -> Outcome<Self> {
        let fit = identify(std::slice::from_ref(&test))?;
        let nominal = nominal(&test, &fit);
        let noise = noise(&test, &fit);
        let arm = noise[1] / noise[0];
        let unit = |c: usize| if c < 3 { 1.0 } else { arm };
        let model: Vec<[f64; 6]> = test
            .readings
            .iter()
            .map(|r| reading(&nominal, r.quaternion))
            .collect();
        let simulated: Vec<f64> = model
            .iter()
            .flat_map(|m| (0..6).map(|c| m[c] / unit(c)).collect::<Vec<_>>())
            .collect();
        let measured = test
            .readings
            .iter()
            .flat_map(|r| (0..6).map(|c| r.load[c] / unit(c)).collect::<Vec<_>>());
        let missed = measured.zip(&simulated).map(|(m, s)| m - s).collect();
        let freedom = (6 * fit.poses.len()) as f64 - N as f64;
        Ok(Self {
            slopes: test
                .readings
                .iter()
                .map(|r| slopes(&nominal, r.quaternion))
                .collect(),
            stated: [
                test.facts.nominal_weight.is_some(),
                test.facts.nominal_com.is_some(),
            ],
            points: points(&test),
            progress: progress(&test),
            noise: (noise[0], freedom.clamp(1.0, 60.0)),
            missed,
            simulated,
            nominal,
            arm,
            test,
        })
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.missed.len()
    }

    /// A column from reading and channel, N or N·m.
    pub fn column(&self, of: impl Fn(usize, usize) -> f64) -> Vec<f64> {
        let unit = |c: usize| if c < 3 { 1.0 } else { self.arm };
        (0..self.rows())
            .map(|row| of(row / 6, row % 6) / unit(row % 6))
            .collect()
    }

    /// The column of a parameter of the statics.
    pub fn parameter(&self, j: usize) -> Vec<f64> {
        self.column(|i, c| self.slopes[i][c][j])
    }

    /// What the weight makes in a channel of a reading, N or N·m.
    pub fn load(&self, i: usize, c: usize) -> f64 {
        self.simulated[6 * i + c] * if c < 3 { 1.0 } else { self.arm }
    }
}

fn nominal(test: &SensorTest, fit: &Account) -> [f64; N] {
    let mut nominal = [0.0; N];
    nominal[0] = test.facts.nominal_weight.unwrap_or(fit.fitted.p[0]);
    let com = test
        .facts
        .nominal_com
        .unwrap_or([fit.fitted.p[1], fit.fitted.p[2], fit.fitted.p[3]]);
    nominal[1..4].copy_from_slice(&com);
    nominal
}

/// As the file says, else what the fit leaves once a polynomial over the orientation is taken out too.
fn noise(test: &SensorTest, fit: &Account) -> [f64; 2] {
    let left = fit.remainder.held_out;
    let size = test
        .readings
        .iter()
        .flat_map(|r| r.load)
        .map(f64::abs)
        .fold(1e-6, f64::max);
    let told = [0, 1].map(|k| fit.fitted.noise[k].min(left[k]).max(1e-6 * size));
    [0, 1].map(|k| test.facts.noise[k].unwrap_or(told[k]))
}

fn points(test: &SensorTest) -> (Vec<usize>, Vec<i64>) {
    let mut names: Vec<i64> = Vec::new();
    let mut own = Vec::new();
    for (i, reading) in test.readings.iter().enumerate() {
        let name = reading.point.unwrap_or(i as i64 + 1);
        let at = names
            .iter()
            .position(|known| *known == name)
            .unwrap_or_else(|| {
                names.push(name);
                names.len() - 1
            });
        own.push(at);
    }
    (own, names)
}

fn progress(test: &SensorTest) -> Vec<f64> {
    let time: Vec<f64> = test.readings.iter().map(|r| r.time).collect();
    let told = time.iter().all(|t| t.is_finite()) && time.iter().any(|t| *t != time[0]);
    let order: Vec<f64> = (0..time.len()).map(|i| i as f64).collect();
    super::table::unit_range(if told { &time } else { &order })
}
