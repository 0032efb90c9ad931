//! The readable truth of a synthetic campaign, and the files it makes.

use super::cubes_truth::CubesTruth;
use super::hammer_truth::HammerTruth;
use super::noise::autoregressive;
use super::recording::Recording;
use super::screw_truth::ScrewTruth;
use super::sensor_truth::SensorTruth;
use super::workspace::WorkspaceTruth;
use crate::effects::{Composite, Scene};
use crate::experiments::schedule;
use crate::ground::files;
use crate::ground::problem::{Outcome, Problem};
use crate::ground::random::Random;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// A campaign with known truth.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Truth {
    /// Robot that the files name.
    pub robot: String,
    /// Where the numbers come from.
    pub source: String,
    /// Seed of all noise.
    pub seed: u64,
    /// The axis tests.
    #[serde(default)]
    pub load_cycle: Vec<LoadCycleTruth>,
    /// The force steps at points of the workspace.
    pub workspace: Option<WorkspaceTruth>,
    /// The hammer tests.
    pub hammer: Option<HammerTruth>,
    /// The measuring cubes.
    #[serde(default)]
    pub cubes: Vec<CubesTruth>,
    /// The force sensors.
    #[serde(default)]
    pub force_sensor: Vec<SensorTruth>,
    /// The screws.
    #[serde(default)]
    pub screw: Vec<ScrewTruth>,
}

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

/// Stated spread of the levers.
const LEVER_REL_STD: f64 = 0.002;
/// Stands apart from the numbers of the axis tests.
const WORKSPACE_SEED: u64 = 900_001;
/// As the seed of the workspace: each kind its own.
const CUBES_SEED: u64 = 910_000;
const SENSOR_SEED: u64 = 920_000;
const SCREW_SEED: u64 = 930_000;
/// Noise of the load cell over the largest force.
const LOAD_CELL: f64 = 5e-5;

/// Number of the hammer tests among the seeds, far from the load cycles: one more of those changes
/// no hammer file. Files of one campaign are struck by the same blows.
const HAMMER: usize = 500_000;

impl Truth {
    /// Reads a truth file.
    pub fn read(path: &Path) -> Outcome<Self> {
        let text = String::from_utf8(files::read_bytes(path)?).map_err(|_| {
            Problem::new("is not UTF-8 text", "give a truth file in TOML").in_file(path)
        })?;
        toml::from_str(&text).map_err(|error| {
            let start = error.span().map_or(0, |s| s.start.min(text.len()));
            let line = text.as_bytes()[..start]
                .iter()
                .filter(|b| **b == b'\n')
                .count()
                + 1;
            Problem::new(
                format!("is not a truth file: {}", error.message().trim()),
                "compare with measurements/kr210/truth.toml",
            )
            .in_file(path)
            .at_line(line)
        })
    }

    /// Makes every file: path relative to the campaign, and text.
    pub fn record(&self) -> Outcome<Vec<(PathBuf, String)>> {
        let load_cycles = self.load_cycle.iter().enumerate();
        let mut files = load_cycles
            .map(|(i, test)| {
                let text = test.record(&self.robot, &self.source, self.seed_of(i as u64))?;
                Ok((PathBuf::from(&test.file), text.text()))
            })
            .collect::<Outcome<Vec<_>>>()?;
        if let Some(test) = &self.workspace {
            let text = test.record(&self.robot, &self.source, self.seed_of(WORKSPACE_SEED))?;
            files.push((PathBuf::from(&test.file), text));
        }
        if let Some(hammer) = &self.hammer {
            let robot = (self.robot.as_str(), self.source.as_str());
            for file in &hammer.file {
                let seed = self.seed_of(HAMMER as u64);
                let record = hammer.record(file, robot, &self.load_cycle, seed)?;
                files.push((PathBuf::from(&file.name), record.text()));
            }
        }
        files.extend(self.instruments()?);
        Ok(files)
    }

    /// Cubes, force sensors and screws.
    fn instruments(&self) -> Outcome<Vec<(PathBuf, String)>> {
        let machine = (self.robot.as_str(), self.source.as_str());
        let mut made: Vec<(String, String)> = Vec::new();
        for (i, test) in self.cubes.iter().enumerate() {
            let seed = self.seed_of(CUBES_SEED + i as u64);
            made.push((test.file.clone(), test.record(machine, seed)?));
        }
        for (i, test) in self.force_sensor.iter().enumerate() {
            let seed = self.seed_of(SENSOR_SEED + i as u64);
            made.push((test.file.clone(), test.record(machine, seed)?.text()));
        }
        for (i, test) in self.screw.iter().enumerate() {
            let seed = self.seed_of(SCREW_SEED + i as u64);
            let record = test.record(machine, seed, &made)?;
            made.push((test.file.clone(), record.text()));
        }
        let named = |(file, text): (String, String)| (PathBuf::from(file), text);
        Ok(made.into_iter().map(named).collect())
    }

    /// Every file has its own noise, so that adding one leaves the others as they were.
    fn seed_of(&self, file: u64) -> u64 {
        self.seed.wrapping_mul(1_000_003).wrapping_add(file)
    }
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
        let mut facts = vec![
            "kind = \"load-cycle\"".to_string(),
            "synthetic = true   # simulated by `ident lab`; nobody measured this".to_string(),
            format!("source = {}", toml::Value::from(source)),
            format!("robot = {}", toml::Value::from(robot)),
            format!("joint = {}", self.joint),
            format!("axis = {}", toml::Value::from(self.axis.as_str())),
            format!("load_lever_m = {:?}", self.load_lever_m),
            format!("sensor_lever_m = {:?}", self.sensor_lever_m),
        ];
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
