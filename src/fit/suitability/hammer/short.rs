//! Time base: a record must hold the band of a robot.

use super::Rule;
use crate::fit::suitability::{Said, Weight};
use crate::measurement::hammer::HammerRecord;
use crate::sheet::number::engineering;

/// Modes of a robot lie between a few and some tens of hertz: the sampling must reach beyond them and the record
/// hold several periods.
pub const RULE: Rule = Rule {
    name: "time-base",
    remedy: "check the unit of the time column (`time_s`, `time_ms`)",
    look,
};

/// Upper end of a robot's first modes, Hz.
const BAND_HZ: f64 = 50.0;
/// Shortest record that resolves a mode, s.
const SHORTEST_S: f64 = 0.2;
/// Longest record of one hit, s.
const LONGEST_S: f64 = 600.0;

fn look(record: &HammerRecord) -> Said {
    let samples = record.runs.iter().map(|run| run.force.len());
    let length = samples.min().unwrap_or(0) as f64 * record.interval_s;
    let nyquist = 0.5 / record.interval_s;
    let one_hit = record.runs.iter().any(|run| run.hit.is_some());
    let mut found = Vec::new();
    if nyquist < BAND_HZ {
        let what = format!(
            "sampled every {}: nothing above {} is seen",
            engineering(record.interval_s, 3, "s"),
            engineering(nyquist, 2, "Hz")
        );
        found.push((Weight::Fatal, what));
    }
    if length < SHORTEST_S || one_hit && length > LONGEST_S {
        let what = format!(
            "a record lasts {}, which is no hammer test of a robot",
            engineering(length, 3, "s")
        );
        found.push((Weight::Fatal, what));
    }
    found
}
