//! An axis test with known truth.

use crate::effects::{Composite, Scene};
use crate::experiments::schedule;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::random::Random;
use crate::laboratory::noise::autoregressive;
use crate::laboratory::recording::{Recording, head};
use serde::Deserialize;
use std::collections::BTreeMap;

/// Stated spread of the levers.
const LEVER_REL_STD: f64 = 0.002;
/// Noise of the load cell over the largest force.
const LOAD_CELL: f64 = 5e-5;

/// One axis test.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LoadCycleTruth {
    /// File to write.
    pub file: String,
    /// Joint 1..6.
    pub joint: usize,
    /// `rotation` or `tilt`.
    pub axis: String,
    /// True stiffness of the joint's spring.
    #[serde(rename = "stiffness_Nm_rad")]
    pub stiffness: f64,
    /// Stiffness that the present simulation uses; the true one if left out.
    #[serde(rename = "nominal_stiffness_Nm_rad")]
    pub nominal: Option<f64>,
    /// Stated spread of the nominal stiffness.
    #[serde(default = "five_percent")]
    pub nominal_stiffness_rel_std: f64,
    /// Lever of the force.
    pub load_lever_m: f64,
    /// Lever of the first laser.
    pub sensor_lever_m: f64,
    /// Lever of the second laser.
    pub sensor2_lever_m: Option<f64>,
    /// Largest force.
    #[serde(rename = "force_N")]
    pub force: f64,
    /// Load schedule.
    #[serde(default = "constant")]
    pub schedule: String,
    /// Number of cycles.
    #[serde(default = "three")]
    pub cycles: usize,
    /// Mean duration of a cycle.
    pub cycle_s: f64,
    /// Unloaded start.
    #[serde(default)]
    pub rest_s: f64,
    /// Sampling interval.
    pub step_s: f64,
    /// Rms of the lasers' noise.
    pub sensor_noise_mm: f64,
    /// Correlation of neighbouring noise samples.
    #[serde(default)]
    pub noise_correlation: f64,
    /// Effects hidden in the file: parameters in SI by their names.
    #[serde(default)]
    pub effects: BTreeMap<String, BTreeMap<String, f64>>,
}

fn five_percent() -> f64 {
    0.05
}
fn constant() -> String {
    "constant".into()
}
fn three() -> usize {
    3
}

impl LoadCycleTruth {
    /// The model and its parameters, SI.
    pub fn model(&self) -> Outcome<(Composite, Vec<f64>)> {
        let names: Vec<&str> = self.effects.keys().map(String::as_str).collect();
        let model = Composite::named(&names)?;
        let mut p = Vec::new();
        for slot in model.slots() {
            let card = slot.effect.card();
            let value = match card.name {
                "spring" => Some(self.stiffness),
                name => self
                    .effects
                    .get(name)
                    .and_then(|own| own.get(slot.parameter.name))
                    .copied(),
            };
            p.push(value.ok_or_else(|| {
                Problem::new(
                    format!(
                        "{}: effect `{}` lacks `{}`",
                        self.file, card.name, slot.parameter.name
                    ),
                    format!("add it in SI: {}", slot.parameter.meaning),
                )
            })?);
        }
        Ok((model, p))
    }

    /// Simulates the test.
    pub fn record(&self, robot: &str, source: &str, seed: u64) -> Outcome<Recording> {
        self.check()?;
        let random = &mut Random::new(seed);
        let largest = self.force * self.load_lever_m;
        let schedule = schedule::named(&self.schedule)?;
        let (time, moment) =
            schedule.history(self.cycles, self.cycle_s, self.rest_s, self.step_s, largest);
        let scene = Scene::new(time.clone(), moment.clone(), self.stiffness, self.cycles);
        let (model, p) = self.model()?;
        let angle = model.predict(&p, &scene);
        let n = time.len();
        let force: Vec<f64> = moment
            .iter()
            .map(|m| m / self.load_lever_m + LOAD_CELL * self.force * random.normal())
            .collect();
        let mut values = vec![
            time,
            force,
            self.laser(&angle, self.sensor_lever_m, random, n),
        ];
        let mut columns = vec!["time_s", "force_N", "displacement_mm"];
        let mut decimals = vec![4, 3, 6];
        if let Some(lever) = self.sensor2_lever_m {
            values.push(self.laser(&angle, lever, random, n));
            columns.push("displacement2_mm");
            decimals.push(6);
        }
        Ok(Recording {
            facts: self.facts(robot, source),
            columns,
            words: Vec::new(),
            decimals,
            values,
        })
    }

    fn laser(&self, angle: &[f64], lever: f64, random: &mut Random, n: usize) -> Vec<f64> {
        let noise = autoregressive(n, self.sensor_noise_mm, self.noise_correlation, random);
        angle
            .iter()
            .zip(noise)
            .map(|(a, e)| 1e3 * a * lever + e)
            .collect()
    }

    fn facts(&self, robot: &str, source: &str) -> Vec<String> {
        let mut facts = head("load-cycle", robot, source);
        facts.extend([
            format!("joint = {}", self.joint),
            format!("axis = {}", toml::Value::from(self.axis.as_str())),
            format!("load_lever_m = {:?}", self.load_lever_m),
            format!("sensor_lever_m = {:?}", self.sensor_lever_m),
        ]);
        facts.extend(
            self.sensor2_lever_m
                .map(|lever| format!("sensor2_lever_m = {lever:?}")),
        );
        facts.extend([
            format!("rest_s = {:?}", self.rest_s),
            format!(
                "nominal_stiffness_Nm_rad = {:?}",
                self.nominal.unwrap_or(self.stiffness)
            ),
            format!(
                "nominal_stiffness_rel_std = {:?}",
                self.nominal_stiffness_rel_std
            ),
            format!("lever_rel_std = {LEVER_REL_STD:?}"),
            format!("sensor_noise_mm = {:?}", self.sensor_noise_mm),
        ]);
        facts
    }

    fn check(&self) -> Outcome<()> {
        let positive = [
            ("stiffness_Nm_rad", self.stiffness),
            ("load_lever_m", self.load_lever_m),
            ("sensor_lever_m", self.sensor_lever_m),
            ("force_N", self.force),
            ("cycle_s", self.cycle_s),
            ("step_s", self.step_s),
        ];
        for (key, value) in positive {
            if !(value > 0.0 && value.is_finite()) {
                return Err(Problem::new(
                    format!("{}: `{key}` is {value}", self.file),
                    "give a number above zero",
                ));
            }
        }
        let rows = (self.cycle_s * self.cycles as f64 + self.rest_s) / self.step_s;
        if !(4.0..=2e7).contains(&rows) {
            return Err(Problem::new(
                format!("{}: would have {rows:.0} rows", self.file),
                "keep between 4 and 20 million",
            ));
        }
        Ok(())
    }
}
