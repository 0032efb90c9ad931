//! What a sensor reads about parameters that were found, with what its amplifiers make of it.

use super::{base_tilt, centre_of_mass, cross_talk, force_gain, sensor_rotation, tool_weight};
use crate::findings::engine::Blamed;
use crate::fit::force_sensor::statics::{ANGLES, N, reading, slopes};
use crate::measurement::force_sensor::SensorTest;

/// What amplifiers make of the six loads, row by column.
pub type Matrix = [[f64; 6]; 6];

/// Amplifiers that show what there is.
pub const IDENTITY: Matrix = [
    [1.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [0.0, 1.0, 0.0, 0.0, 0.0, 0.0],
    [0.0, 0.0, 1.0, 0.0, 0.0, 0.0],
    [0.0, 0.0, 0.0, 1.0, 0.0, 0.0],
    [0.0, 0.0, 0.0, 0.0, 1.0, 0.0],
    [0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
];

/// Readings about some parameters and amplifiers.
#[derive(Debug, Clone)]
pub struct About {
    /// Parameters of the statics; offsets stay zero.
    p: [f64; N],
    matrix: Matrix,
    /// Load of the weight at every reading, N and N·m.
    pub load: Vec<[f64; 6]>,
    /// The same as the sensor shows it.
    pub shown: Vec<[f64; 6]>,
    /// Its slopes along the parameters.
    pub slopes: Vec<[[f64; N]; 6]>,
}

impl About {
    /// Of a file.
    pub fn of(test: &SensorTest, p: [f64; N], matrix: Matrix) -> Self {
        let load: Vec<[f64; 6]> = test
            .readings
            .iter()
            .map(|r| reading(&p, r.quaternion))
            .collect();
        let own = |r: &crate::measurement::force_sensor::Reading| {
            amplified(&matrix, &slopes(&p, r.quaternion))
        };
        Self {
            shown: load.iter().map(|l| shown(&matrix, l)).collect(),
            slopes: test.readings.iter().map(own).collect(),
            load,
            p,
            matrix,
        }
    }

    /// The same with causes, and weight and centre as far off as they are.
    pub fn with(&self, test: &SensorTest, causes: &[Blamed], uncertain: &[f64]) -> Self {
        let (mut p, mut matrix) = (self.p, self.matrix);
        (0..4).zip(uncertain).for_each(|(j, amount)| p[j] += amount);
        for cause in causes {
            let first = match cause.effect {
                e if e == tool_weight::EFFECT.name => Some(0),
                e if e == centre_of_mass::EFFECT.name => Some(1),
                e if e == sensor_rotation::EFFECT.name => Some(ANGLES),
                e if e == base_tilt::EFFECT.name => Some(ANGLES + 3),
                _ => None,
            };
            if let Some(first) = first {
                let places = cause.shape.iter().map(|k| first + *k as usize);
                let places = places.chain(cause.shape.is_empty().then_some(first));
                places
                    .zip(&cause.amounts)
                    .for_each(|(j, amount)| p[j] += amount);
            }
            if cause.effect == force_gain::EFFECT.name {
                let axes = force_gain::axes(cause);
                axes.for_each(|c| matrix[c][c] += cause.amounts[0]);
            }
            if cause.effect == cross_talk::EFFECT.name {
                matrix[cause.shape[1] as usize][cause.shape[0] as usize] += cause.amounts[0];
            }
        }
        Self::of(test, p, matrix)
    }

    /// What parameters and amplifiers make more than the nominal ones, to first order about this.
    pub fn moved(&self, nominal: &[f64; N]) -> Vec<[f64; 6]> {
        let each = self.slopes.iter().zip(&self.load);
        let moved = |(slopes, load): (&[[f64; N]; 6], &[f64; 6])| {
            std::array::from_fn(|c| {
                let along: f64 = (0..N)
                    .map(|j| slopes[c][j] * (self.p[j] - nominal[j]))
                    .sum();
                let amplified = |k: usize| (self.matrix[c][k] - IDENTITY[c][k]) * load[k];
                along + (0..6).map(amplified).sum::<f64>()
            })
        };
        each.map(moved).collect()
    }
}

fn shown(matrix: &Matrix, load: &[f64; 6]) -> [f64; 6] {
    std::array::from_fn(|c| (0..6).map(|k| matrix[c][k] * load[k]).sum())
}

fn amplified(matrix: &Matrix, slopes: &[[f64; N]; 6]) -> [[f64; N]; 6] {
    std::array::from_fn(|c| {
        std::array::from_fn(|j| (0..6).map(|k| matrix[c][k] * slopes[k][j]).sum())
    })
}
