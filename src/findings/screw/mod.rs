//! What is wrong with a linear axis: its readings less a perfect screw.

mod backlash;
mod cyclic_error;
mod experiment;
mod outlier_run;
mod pitch_scale;
mod thermal_growth;
mod wear_zone;

use super::table::Effect;
use crate::fit::screw::cyclic::Sight;
use crate::measurement::screw::ScrewTest;
use std::collections::BTreeMap;

/// Every effect of this kind.
pub const EFFECTS: &[Effect<Case>] = &[
    pitch_scale::EFFECT,
    backlash::EFFECT,
    cyclic_error::EFFECT,
    wear_zone::EFFECT,
    thermal_growth::EFFECT,
    outlier_run::EFFECT,
];

/// A screw test as its diagnosis sees it: one row per reading.
#[derive(Debug, Clone)]
pub struct Case {
    /// The file.
    pub test: ScrewTest,
    /// Deviation of every row, m.
    pub deviation: Vec<f64>,
    /// Target of every row less the middle of the travel, m.
    pub at: Vec<f64>,
    /// +½ on the way back, −½ on the way there: what a lost motion of one adds.
    pub side: Vec<f64>,
    /// Warmth of every row: temperature, else time, else the order of the readings; 0 to 1.
    pub progress: Vec<f64>,
    /// Whether it is a temperature, K per unit where it is.
    pub temperature_range: Option<f64>,
    /// Half of the travel, m.
    pub half: f64,
    /// Noise of one reading, m, and the readings that it is worth.
    pub noise: (f64, f64),
    /// What the targets show of an error per turn.
    pub sight: Sight,
}

impl Case {
    /// Of a file.
    pub fn new(test: ScrewTest) -> Self {
        let target: Vec<f64> = test.readings.iter().map(|r| r.target).collect();
        let low = target.iter().copied().fold(f64::INFINITY, f64::min);
        let high = target.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let middle = 0.5 * (low + high);
        let deviation: Vec<f64> = test.readings.iter().map(|r| r.actual - r.target).collect();
        let temperature: Vec<f64> = test.readings.iter().map(|r| r.temperature).collect();
        let time: Vec<f64> = test.readings.iter().map(|r| r.time).collect();
        let told = |v: &[f64]| v.iter().all(|x| x.is_finite()) && v.iter().any(|x| *x != v[0]);
        let order: Vec<f64> = (0..deviation.len()).map(|i| i as f64).collect();
        let warm = told(&temperature);
        let progress = match (warm, told(&time)) {
            (true, _) => &temperature,
            (_, true) => &time,
            _ => &order,
        };
        let range = temperature
            .iter()
            .copied()
            .fold(f64::NEG_INFINITY, f64::max)
            - temperature.iter().copied().fold(f64::INFINITY, f64::min);
        let noise = noise(&test, &deviation);
        Self {
            at: target.iter().map(|x| x - middle).collect(),
            side: test
                .readings
                .iter()
                .map(|r| if r.forward { -0.5 } else { 0.5 })
                .collect(),
            progress: super::table::unit_range(progress),
            temperature_range: warm.then_some(range),
            half: (0.5 * (high - low)).max(f64::MIN_POSITIVE),
            sight: Sight::of(&target, test.facts.pitch),
            noise,
            deviation,
            test,
        }
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.deviation.len()
    }

    /// A column over all rows.
    pub fn column(&self, of: impl Fn(usize) -> f64) -> Vec<f64> {
        (0..self.rows()).map(of).collect()
    }

    /// Whether both directions were measured.
    pub fn both_ways(&self) -> bool {
        self.side.iter().any(|s| *s > 0.0) && self.side.iter().any(|s| *s < 0.0)
    }

    /// Numbers of the runs, ascending.
    pub fn runs(&self) -> Vec<i64> {
        let mut runs: Vec<i64> = self.test.readings.iter().map(|r| r.run).collect();
        runs.sort_unstable();
        runs.dedup();
        runs
    }
}

/// Noise of a reading from what does not repeat at a target once each run's own mean is taken out (by
/// medians, so that one wild run does not count), and its degrees of freedom.
fn noise(test: &ScrewTest, deviation: &[f64]) -> (f64, f64) {
    let key = |i: usize| {
        (
            test.readings[i].forward,
            (test.readings[i].target * 1e9).round() as i64,
        )
    };
    let mut groups: BTreeMap<(bool, i64), Vec<usize>> = BTreeMap::new();
    (0..deviation.len()).for_each(|i| groups.entry(key(i)).or_default().push(i));
    let mut left = deviation.to_vec();
    for _ in 0..2 {
        centre(&mut left, groups.values());
        let mut runs: BTreeMap<(i64, bool), Vec<usize>> = BTreeMap::new();
        for (i, r) in test.readings.iter().enumerate() {
            runs.entry((r.run, r.forward)).or_default().push(i);
        }
        centre(&mut left, runs.values());
    }
    let repeated: Vec<&Vec<usize>> = groups.values().filter(|g| g.len() > 1).collect();
    let freedom: usize = repeated.iter().map(|g| g.len() - 1).sum();
    let squares: f64 = repeated
        .iter()
        .flat_map(|g| g.iter())
        .map(|i| left[*i].powi(2))
        .sum();
    let floor = test.facts.scale_noise.unwrap_or(1e-8).max(1e-9);
    match freedom {
        0..4 => (floor, 0.0),
        n => ((squares / n as f64).sqrt().max(0.3 * floor), n as f64),
    }
}

fn centre<'a>(values: &mut [f64], groups: impl Iterator<Item = &'a Vec<usize>>) {
    for group in groups {
        let own: Vec<f64> = group.iter().map(|i| values[*i]).collect();
        let middle = crate::signal::outliers::median(&own);
        group.iter().for_each(|i| values[*i] -= middle);
    }
}
