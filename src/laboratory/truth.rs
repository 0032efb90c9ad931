//! The readable truth of a synthetic campaign, and the files it makes.

mod load_cycle;

use super::cubes_truth::CubesTruth;
use super::hammer_truth::HammerTruth;
use super::screw_truth::ScrewTruth;
use super::sensor_truth::SensorTruth;
use super::workspace::WorkspaceTruth;
use crate::ground::files;
use crate::ground::problem::{Outcome, Problem, line_of_toml};
pub use load_cycle::LoadCycleTruth;
use serde::Deserialize;
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

/// Stands apart from the numbers of the axis tests.
const WORKSPACE_SEED: u64 = 900_001;
/// As the seed of the workspace: each kind its own.
const CUBES_SEED: u64 = 910_000;
const SENSOR_SEED: u64 = 920_000;
const SCREW_SEED: u64 = 930_000;

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
            Problem::new(
                format!("is not a truth file: {}", error.message().trim()),
                "compare with measurements/kr210/truth.toml",
            )
            .in_file(path)
            .at_line(line_of_toml(&text, &error))
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
