//! A case: robot file, measurement, and everything that is true about them.

use super::robot::Robot;
use super::robot_text::robot_text;
use std::path::{Path, PathBuf};

/// An effect that is really in the data.
#[derive(Clone, Debug)]
pub struct Truth {
    pub effect: &'static str,
    /// Names of the place that count as right. Empty: the contract has no name for it.
    pub sites: Vec<String>,
    /// Largest visible change over the uncertainty of the readings.
    pub strength: f64,
    /// What a person would want to know of it.
    pub detail: String,
}

impl Truth {
    pub fn at(&self, site: &str) -> bool {
        self.sites.is_empty() || self.sites.iter().any(|s| s == site)
    }
}

pub struct Case {
    pub kind: String,
    pub seed: u64,
    /// Empty: clean. Effects outside the library begin with `outside:`.
    pub truths: Vec<Truth>,
    /// What the present simulation says.
    pub file: Robot,
    /// What the robot is, as far as springs, axes and bodies can say it.
    pub real: Robot,
    pub csv: String,
    /// Conditions of the measurement, for the log.
    pub note: String,
}

impl Case {
    /// Writes robot file and measurement into `folder`.
    pub fn write(&self, folder: &Path) -> PathBuf {
        let robot = robot_text(&self.file).expect("a robot file knows no sliding axis");
        std::fs::write(folder.join("robot.toml"), robot).unwrap();
        let path = folder.join("measurement.csv");
        std::fs::write(&path, &self.csv).unwrap();
        path
    }

    /// One line of everything hidden.
    pub fn hidden(&self) -> String {
        let each = self.truths.iter().map(|t| {
            format!(
                "{}@{} x{:.1} ({})",
                t.effect,
                t.sites.join("/"),
                t.strength,
                t.detail
            )
        });
        each.collect::<Vec<_>>().join(" + ")
    }
}

/// Limits of the strength of a hidden effect.
pub const WEAKEST: f64 = 3.0;
pub const STRONGEST: f64 = 30.0;

/// The size in 0..1 at which a strength that grows with size comes to `target`; the end of the range
/// where that is not reached but visible all the same. `None`: cannot be seen here, or is too strong.
pub fn size_for(target: f64, strength: impl Fn(f64) -> f64) -> Option<f64> {
    let (least, most) = (strength(0.0), strength(1.0));
    if least > STRONGEST || most < WEAKEST {
        return None;
    }
    if least >= target || most <= target {
        return Some(if least >= target { 0.0 } else { 1.0 });
    }
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..18 {
        let middle = 0.5 * (low + high);
        match strength(middle) < target {
            true => low = middle,
            false => high = middle,
        }
    }
    Some(high)
}

/// Between `from` at size 0 and `to` at size 1, in equal ratios.
pub fn between(from: f64, to: f64, size: f64) -> f64 {
    from * (to / from).powf(size)
}
