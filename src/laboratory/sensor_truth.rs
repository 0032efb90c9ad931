//! Simulated readings of a force-torque sensor that carries a spindle through many orientations.

use super::recording::{Recording, head};
use crate::fit::force_sensor::statics::{N, reading};
use crate::ground::problem::{Outcome, Problem};
use crate::ground::random::Random;
use crate::ground::spatial::{V3, of_quaternion};
use crate::ground::units::DEGREE;
use crate::measurement::force_sensor::quaternion;
use serde::Deserialize;

/// One force-sensor test of a campaign.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SensorTruth {
    /// File to write.
    pub file: String,
    /// True weight.
    #[serde(rename = "weight_N")]
    pub weight: f64,
    /// True centre of mass, sensor frame.
    pub com_m: V3,
    /// Offsets of the forces.
    #[serde(rename = "offset_N")]
    pub offset_force: V3,
    /// Offsets of the moments.
    #[serde(rename = "offset_Nm")]
    pub offset_moment: V3,
    /// Turn of the sensor about its axes, a rotation vector.
    pub turn_deg: V3,
    /// Tilt of the robot's base about its x and y.
    pub tilt_deg: [f64; 2],
    /// Pull of the hose along the sensor's x, at its largest where the sensor's z points along base x: it is
    /// fixed to the forearm there and stretched.
    #[serde(rename = "hose_N")]
    pub hose: f64,
    /// Angles A, B and C: every combination is an orientation.
    pub a_deg: Vec<f64>,
    /// See `a_deg`.
    pub b_deg: Vec<f64>,
    /// See `a_deg`.
    pub c_deg: Vec<f64>,
    /// Noise of the forces.
    #[serde(rename = "noise_N")]
    pub noise_force: f64,
    /// Noise of the moments.
    #[serde(rename = "noise_Nm")]
    pub noise_moment: f64,
    /// What the present model says: weight.
    #[serde(rename = "nominal_weight_N")]
    pub nominal_weight: f64,
    /// What the present model says: centre of mass.
    pub nominal_com_m: V3,
    /// Relative standard deviation of both.
    pub nominal_rel_std: f64,
}

/// Where the hose pulls, along the sensor's z.
const HOSE_HEIGHT_M: f64 = 0.1;

impl SensorTruth {
    /// Simulates the test.
    ///
    /// # Errors
    /// No orientation, or a number that cannot be.
    pub fn record(&self, (robot, source): (&str, &str), seed: u64) -> Outcome<Recording> {
        let p = self.parameters();
        let count = self.a_deg.len() * self.b_deg.len() * self.c_deg.len();
        let spreads = [self.noise_force, self.noise_moment, self.nominal_rel_std];
        if !(1..=100_000).contains(&count) || !spreads.iter().all(|s| *s > 0.0 && s.is_finite()) {
            return Err(Problem::new(
                format!("{}: orientations, noise or spread cannot be", self.file),
                "give lists of angles, noise and spread above zero",
            ));
        }
        let random = &mut Random::new(seed);
        let mut values = vec![Vec::new(); 10];
        for (i, abc) in self.orientations().enumerate() {
            let [a, b, c] = abc.map(|angle| angle * DEGREE);
            let q = quaternion(a, b, c);
            let (load, hose) = (reading(&p, q), self.pull(q));
            let read = (0..6).map(|k| {
                let noise = if k < 3 {
                    self.noise_force
                } else {
                    self.noise_moment
                };
                load[k] + hose[k] + noise * random.normal()
            });
            let row = [(i + 1) as f64].into_iter().chain(abc).chain(read);
            row.zip(&mut values).for_each(|(x, column)| column.push(x));
        }
        Ok(Recording {
            facts: self.facts(robot, source),
            columns: vec![
                "point", "a_deg", "b_deg", "c_deg", "fx_N", "fy_N", "fz_N", "mx_Nm", "my_Nm",
                "mz_Nm",
            ],
            words: Vec::new(),
            decimals: vec![0, 3, 3, 3, 4, 4, 4, 5, 5, 5],
            values,
        })
    }

    fn orientations(&self) -> impl Iterator<Item = V3> + '_ {
        let with =
            move |a: &f64, b: &f64| self.c_deg.iter().map(|c| [*a, *b, *c]).collect::<Vec<_>>();
        self.a_deg
            .iter()
            .flat_map(move |a| self.b_deg.iter().flat_map(move |b| with(a, b)))
    }

    fn parameters(&self) -> [f64; N] {
        let [rx, ry, rz] = self.turn_deg.map(|d| d * DEGREE);
        let [tx, ty] = self.tilt_deg.map(|d| d * DEGREE);
        let ([x, y, z], [fx, fy, fz], [mx, my, mz]) =
            (self.com_m, self.offset_force, self.offset_moment);
        [
            self.weight,
            x,
            y,
            z,
            fx,
            fy,
            fz,
            mx,
            my,
            mz,
            rx,
            ry,
            rz,
            tx,
            ty,
        ]
    }

    /// Force and moment of the hose, sensor axes.
    fn pull(&self, q: [f64; 4]) -> [f64; 6] {
        let size = self.hose * of_quaternion(q)[0][2];
        [size, 0.0, 0.0, 0.0, HOSE_HEIGHT_M * size, 0.0]
    }

    fn facts(&self, robot: &str, source: &str) -> Vec<String> {
        let mut facts = head("force-sensor", robot, source);
        facts.extend([
            format!("nominal_weight_N = {:?}", self.nominal_weight),
            format!("nominal_com_m = {:?}", self.nominal_com_m),
            format!("nominal_rel_std = {:?}", self.nominal_rel_std),
            format!("sensor_noise_N = {:?}", self.noise_force),
            format!("sensor_noise_Nm = {:?}", self.noise_moment),
        ]);
        facts
    }
}
