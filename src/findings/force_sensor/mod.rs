//! What is wrong with a force sensor or its load: readings of a sensor that touches nothing, less what the
//! nominal tool makes.

mod about;
mod base_tilt;
mod centre_of_mass;
mod cross_talk;
mod experiment;
mod force_gain;
mod hose_force;
mod outlier_point;
mod patterns;
mod sensor_offset;
mod sensor_rotation;
mod thermal_drift;
mod tool_weight;

use super::engine::Blamed;
use super::table::Effect;
use crate::fit::force_sensor::statics::N;
use crate::fit::force_sensor::{Account, identify};
use crate::ground::problem::Outcome;
use crate::measurement::force_sensor::SensorTest;
use about::{About, IDENTITY};

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
    /// What it is stated about: the nominal one, or one with what was found in place.
    pub(super) about: About,
    /// Measured less simulated, what was found with its slopes beside, N.
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
        let points = points(&test);
        let (noise, worth) = noise(&test, &fit, &points.0);
        let mut case = Self {
            stated: [
                test.facts.nominal_weight.is_some(),
                test.facts.nominal_com.is_some(),
            ],
            progress: progress(&test, points.1.len()),
            about: About::of(&test, nominal, IDENTITY),
            arm: noise[1] / noise[0],
            noise: (noise[0], worth),
            missed: Vec::new(),
            points,
            nominal,
            test,
        };
        case.missed = case.column(|i, c| case.test.readings[i].load[c] - case.about.shown[i][c]);
        Ok(case)
    }

    /// The same about causes and uncertain numbers that were found: turned far, or multiplied with one another,
    /// they are not linear.
    pub(super) fn beside(&self, causes: &[Blamed], uncertain: &[f64]) -> Self {
        let about = self.about.with(&self.test, causes, uncertain);
        let moved = about.moved(&self.nominal);
        let left =
            |i: usize, c: usize| self.test.readings[i].load[c] - about.shown[i][c] + moved[i][c];
        Self {
            missed: self.column(left),
            about,
            test: self.test.clone(),
            points: self.points.clone(),
            progress: self.progress.clone(),
            ..*self
        }
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        6 * self.test.readings.len()
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
        self.column(|i, c| self.about.slopes[i][c][j])
    }

    /// What the weight makes in a channel of a reading, N or N·m.
    pub fn load(&self, i: usize, c: usize) -> f64 {
        self.about.load[i][c]
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

/// Rows that a stated noise is worth.
const WORTH: f64 = 60.0;
/// Repeated readings from which they tell the noise, degrees of freedom.
const TELLING: usize = 12;

/// As the file says, else by how readings of one point differ, else what the fit leaves once a polynomial over
/// the orientation is taken out too; and the rows it is worth. What a fit leaves may hold what is wrong: it is
/// worth nothing against the readings themselves.
fn noise(test: &SensorTest, fit: &Account, points: &[usize]) -> ([f64; 2], f64) {
    let left = fit.remainder.held_out;
    let size = test
        .readings
        .iter()
        .flat_map(|r| r.load)
        .map(f64::abs)
        .fold(1e-6, f64::max);
    let per_point = (test.readings.len() as f64 / fit.poses.len().max(1) as f64).sqrt();
    let told = [0, 1].map(|k| (per_point * fit.fitted.noise[k].min(left[k])).max(1e-6 * size));
    let (repeated, freedom) = repeated(test, points);
    let repeats = freedom >= TELLING && repeated.iter().all(|n| *n > 1e-6 * size);
    let found = if repeats { repeated } else { told };
    let stated = test.facts.noise.iter().all(Option::is_some);
    let worth = match (stated, repeats) {
        (true, _) => WORTH,
        (_, true) => (freedom as f64).min(WORTH),
        _ => 0.0,
    };
    (
        [0, 1].map(|k| test.facts.noise[k].unwrap_or(found[k])),
        worth,
    )
}

/// How readings of one point scatter, forces and moments, and the degrees of freedom of either.
fn repeated(test: &SensorTest, points: &[usize]) -> ([f64; 2], usize) {
    let count = points.iter().max().map_or(0, |p| p + 1);
    let (mut squares, mut freedom) = ([0.0; 2], 0);
    for point in 0..count {
        let own = || {
            test.readings
                .iter()
                .zip(points)
                .filter(|(_, p)| **p == point)
                .map(|(r, _)| r)
        };
        let n = own().count();
        for c in 0..6 {
            let mean = own().map(|r| r.load[c]).sum::<f64>() / n as f64;
            squares[c / 3] += own().map(|r| (r.load[c] - mean).powi(2)).sum::<f64>();
        }
        freedom += 3 * (n - 1);
    }
    (squares.map(|s| (s / freedom.max(1) as f64).sqrt()), freedom)
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

/// Time of every reading from when the sensor was set to zero, one step before the first point, to the last.
fn progress(test: &SensorTest, points: usize) -> Vec<f64> {
    let time: Vec<f64> = test.readings.iter().map(|r| r.time).collect();
    let told = time.iter().all(|t| t.is_finite()) && time.iter().any(|t| *t != time[0]);
    let order: Vec<f64> = (0..time.len()).map(|i| i as f64).collect();
    let lead = (points.max(2) as f64 - 1.0).recip();
    let each = super::table::unit_range(if told { &time } else { &order });
    each.iter().map(|u| (u + lead) / (1.0 + lead)).collect()
}
