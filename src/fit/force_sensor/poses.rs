//! Readings of one point become one: noise within a point is not what limits the fit.

use crate::ground::problem::{Outcome, Problem};
use crate::ground::stats::length;
use crate::measurement::force_sensor::{Reading, SensorTest};

/// The mean reading of one point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// Unit quaternion w, x, y, z: turns sensor axes into base axes.
    pub quaternion: [f64; 4],
    /// Force, N, then moment, N·m, sensor frame.
    pub load: [f64; 6],
    /// How many readings it is the mean of.
    pub count: usize,
}

/// One pose per point; readings without a point number are poses of their own.
///
/// # Errors
/// Fewer than two.
pub fn poses(tests: &[SensorTest]) -> Outcome<Vec<Pose>> {
    let mut found = Vec::new();
    for test in tests {
        let mut sums: Vec<(i64, Pose)> = Vec::new();
        for reading in &test.readings {
            let same = reading
                .point
                .and_then(|p| sums.iter_mut().find(|(known, _)| *known == p));
            match same {
                Some((_, pose)) => pose.add(reading),
                None => sums.push((
                    reading.point.unwrap_or(i64::MIN + sums.len() as i64),
                    Pose::of(reading),
                )),
            }
        }
        found.extend(sums.into_iter().map(|(_, pose)| pose.mean()));
    }
    if found.len() >= 2 {
        return Ok(found);
    }
    let problem = Problem::new(
        "holds a single orientation",
        "turn the sensor: z up, z down and z level are the least (source 002, 2.6)",
    );
    Err(tests
        .iter()
        .fold(problem, |problem, test| problem.in_text(&test.path)))
}

impl Pose {
    fn of(reading: &Reading) -> Self {
        Self {
            quaternion: reading.quaternion,
            load: reading.load,
            count: 1,
        }
    }

    /// Adds a reading; q and −q are one orientation, so it is brought to the same side first.
    fn add(&mut self, reading: &Reading) {
        let along: f64 = self
            .quaternion
            .iter()
            .zip(&reading.quaternion)
            .map(|(a, b)| a * b)
            .sum();
        let sign = if along < 0.0 { -1.0 } else { 1.0 };
        for (sum, q) in self.quaternion.iter_mut().zip(&reading.quaternion) {
            *sum += sign * q;
        }
        for (sum, load) in self.load.iter_mut().zip(&reading.load) {
            *sum += load;
        }
        self.count += 1;
    }

    fn mean(mut self) -> Self {
        let length = length(&self.quaternion);
        self.quaternion = self.quaternion.map(|x| x / length.max(f64::MIN_POSITIVE));
        self.load = self.load.map(|x| x / self.count as f64);
        self
    }
}

/// Noise that the files state, forces in N and moments in N·m, of the mean of a point.
pub fn stated_noise(tests: &[SensorTest]) -> [Option<f64>; 2] {
    let readings: usize = tests.iter().map(|t| t.readings.len()).sum();
    let points = poses(tests).map_or(1, |p| p.len());
    let share = (points as f64 / readings.max(1) as f64).sqrt();
    [0, 1].map(|kind| {
        tests
            .iter()
            .find_map(|t| t.facts.noise[kind])
            .map(|noise| noise * share)
    })
}
