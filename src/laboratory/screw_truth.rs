//! Simulated runs of a linear axis against a scale: a worn screw, with or without the table that corrects it.

use super::recording::{Recording, head};
use crate::fit::screw::groups::Joint;
use crate::fit::screw::positions::Extremes;
use crate::fit::screw::{Request, identify};
use crate::ground::problem::{Outcome, Problem};
use crate::ground::random::Random;
use crate::measurement::pitch_table::PitchTable;
use crate::measurement::screw::ScrewTest;
use crate::measurement::table::Table;
use serde::Deserialize;
use std::f64::consts::TAU;
use std::path::Path;

/// One screw test of a campaign.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ScrewTruth {
    /// File to write.
    pub file: String,
    /// Travel per turn.
    pub pitch_mm: f64,
    /// First target.
    pub from_mm: f64,
    /// Distance of the targets: off the pitch, as ISO 230-2 asks.
    pub step_mm: f64,
    /// Number of targets.
    pub targets: usize,
    /// Runs in each direction.
    pub runs: usize,
    /// Error per travel, µm/m.
    pub scale_um_m: f64,
    /// Amplitude of the error once per turn, µm.
    pub cyclic_um: f64,
    /// Lost motion, µm.
    pub backlash_um: f64,
    /// A worn stretch: its middle and half width, mm, and how deep the error is there, µm.
    pub worn_mm: [f64; 2],
    /// Depth of the worn stretch, µm.
    pub wear_um: f64,
    /// What does not repeat, µm.
    pub noise_um: f64,
    /// An earlier file of this campaign: the axis is measured again with the table that follows from it.
    pub corrected_by: Option<String>,
}

impl ScrewTruth {
    /// Simulates the test. `earlier`: the files written so far.
    ///
    /// # Errors
    /// A number that cannot be, or `corrected_by` names no earlier file.
    pub fn record(
        &self,
        machine: (&str, &str),
        seed: u64,
        earlier: &[(String, String)],
    ) -> Outcome<Recording> {
        self.check()?;
        let table = self
            .corrected_by
            .as_deref()
            .map(|name| table_of(name, earlier));
        let table = table.transpose()?;
        let random = &mut Random::new(seed);
        let (mut words, mut values) = (Vec::new(), vec![Vec::new(); 3]);
        for run in 1..=self.runs {
            for forward in [true, false] {
                for i in 0..self.targets {
                    let n = if forward { i } else { self.targets - 1 - i };
                    let x = self.from_mm + self.step_mm * n as f64;
                    let told = x + table
                        .as_ref()
                        .map_or(0.0, |t| 1e-3 * t.correction_um(x, forward));
                    let actual = told
                        + 1e-3 * (self.error_um(told, forward) + self.noise_um * random.normal());
                    words.push(if forward { "forward" } else { "backward" });
                    [run as f64, x, actual]
                        .into_iter()
                        .enumerate()
                        .for_each(|(c, v)| values[c].push(v));
                }
            }
        }
        Ok(Recording {
            facts: self.facts(machine),
            columns: vec!["direction", "run", "target_mm", "actual_mm"],
            words,
            decimals: vec![0, 4, 5],
            values,
        })
    }

    /// Actual less told position, µm.
    pub fn error_um(&self, x: f64, forward: bool) -> f64 {
        let [middle, half] = self.worn_mm;
        let worn = (-((x - middle) / half).powi(2)).exp();
        let cyclic = (TAU * x / self.pitch_mm).sin();
        let way = if forward { -0.5 } else { 0.5 };
        1e-3 * self.scale_um_m * x
            + self.cyclic_um * cyclic
            + self.wear_um * worn
            + way * self.backlash_um
    }

    fn facts(&self, (machine, source): (&str, &str)) -> Vec<String> {
        let mut facts = head("screw", machine, source);
        facts.extend([format!("pitch_mm = {:?}", self.pitch_mm)]);
        let corrected = self.corrected_by.iter();
        facts.extend(corrected.map(|by| format!("notes = {{ corrected_by = {by:?} }}")));
        facts
    }

    fn check(&self) -> Outcome<()> {
        let positive = [self.pitch_mm, self.step_mm, self.worn_mm[1]];
        let rows = self.targets.saturating_mul(self.runs);
        match positive.iter().all(|x| *x > 0.0 && x.is_finite()) && (1..=100_000).contains(&rows) {
            true => Ok(()),
            false => Err(Problem::new(
                format!("{}: pitch, step, widths or counts cannot be", self.file),
                "give lengths above zero and at least one run and target",
            )),
        }
    }
}

/// The table that follows from an earlier file, as `ident screw` writes it.
fn table_of(name: &str, earlier: &[(String, String)]) -> Outcome<PitchTable> {
    let found = earlier.iter().find(|file| file.0 == name);
    let (_, text) = found.ok_or_else(|| {
        Problem::new(
            format!("`corrected_by` names `{name}`, which is no earlier file of this campaign"),
            "name a screw file that stands before it",
        )
    })?;
    let path = Path::new(name);
    let test = ScrewTest::from_table(Table::from_reader(
        path,
        text.as_bytes(),
        text.len() as u64,
    )?)?;
    let request = Request {
        residual: 3e-6,
        coverage: 2.0,
        extremes: Extremes::Dropped,
        joint: Joint::Free,
        smooth: false,
    };
    Ok(identify(&[test], &request)?.table(false))
}
