//! What is wrong with a linear axis: its readings less a perfect screw.

mod backlash;
mod cyclic_error;
mod experiment;
mod outlier_run;
mod patterns;
mod pitch_scale;
mod thermal_growth;
mod wear_zone;

use super::table::Effect;
use crate::fit::screw::cyclic::Sight;
use crate::ground::stats::mean;
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
    /// Time of every row, else the order of the readings; 0 to 1.
    pub lapse: Vec<f64>,
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
        let order = order(&test);
        let warm = told(&temperature);
        let lapse = if told(&time) { &time } else { &order };
        let progress = if warm { &temperature } else { lapse };
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
            lapse: super::table::unit_range(lapse),
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

    /// How many targets there are.
    pub fn targets(&self) -> usize {
        let mut all: Vec<i64> = self.at.iter().map(|x| (x * 1e9).round() as i64).collect();
        all.sort_unstable();
        all.dedup();
        all.len()
    }

    /// Numbers of the runs, ascending.
    pub fn runs(&self) -> Vec<i64> {
        let mut runs: Vec<i64> = self.test.readings.iter().map(|r| r.run).collect();
        runs.sort_unstable();
        runs.dedup();
        runs
    }
}

/// The order of the readings: that of the file, or, where it is sorted otherwise, the one in which an axis
/// passes its targets.
fn order(test: &ScrewTest) -> Vec<f64> {
    let readings = &test.readings;
    let mut rows: Vec<usize> = (0..readings.len()).collect();
    if !readings.windows(2).all(|w| w[0].run <= w[1].run) {
        let passed = |i: usize| {
            let r = &readings[i];
            (
                r.run,
                !r.forward,
                if r.forward { r.target } else { -r.target },
            )
        };
        rows.sort_by(|a, b| {
            let order = passed(*a).partial_cmp(&passed(*b));
            order.unwrap_or(std::cmp::Ordering::Equal)
        });
    }
    let mut order = vec![0.0; rows.len()];
    rows.iter()
        .enumerate()
        .for_each(|(at, row)| order[*row] = at as f64);
    order
}

/// A step between neighbours this many times as large as usual is one, and no noise.
const STEP: f64 = 6.0;
/// Readings that a difference of neighbours is worth (white noise: its fourth moment over that of one reading).
const NEIGHBOURS: f64 = 2.0 / 3.0;

/// Noise of a reading from how what does not repeat at a target differs between neighbours of one sweep, so that
/// neither a screw that grows nor a run that slipped counts as noise; and the readings that it is worth.
fn noise(test: &ScrewTest, deviation: &[f64]) -> (f64, f64) {
    let place = |i: usize| (test.readings[i].target * 1e9).round() as i64;
    let mut left = deviation.to_vec();
    let at_target = grouped(test, |i| (i64::from(test.readings[i].forward), place(i)));
    centre(&mut left, at_target.iter());
    let mut squares = Vec::new();
    for mut sweep in grouped(test, |i| {
        (test.readings[i].run, i64::from(test.readings[i].forward))
    }) {
        sweep.sort_by_key(|i| place(*i));
        squares.extend(
            sweep
                .windows(2)
                .map(|w| 0.5 * (left[w[1]] - left[w[0]]).powi(2)),
        );
    }
    let usual = crate::signal::outliers::median(&squares) / MEDIAN_SQUARE;
    squares.retain(|s| usual <= 0.0 || *s <= STEP * STEP * usual);
    let repeated = at_target.iter().filter(|g| g.len() > 1);
    let freedom: usize = repeated.map(|g| g.len() - 1).sum();
    let share = freedom as f64 / left.len().max(1) as f64;
    let floor = test.facts.scale_noise.unwrap_or(1e-8).max(1e-9);
    match freedom {
        0..4 => (floor, 0.0),
        n => {
            let mean = mean(&squares);
            (
                (mean / share).sqrt().max(0.3 * floor),
                NEIGHBOURS * n as f64,
            )
        }
    }
}

/// Median of the square of a normal variable.
const MEDIAN_SQUARE: f64 = 0.454_936_4;

/// Rows by a key.
fn grouped(test: &ScrewTest, key: impl Fn(usize) -> (i64, i64)) -> Vec<Vec<usize>> {
    let mut groups: BTreeMap<(i64, i64), Vec<usize>> = BTreeMap::new();
    (0..test.readings.len()).for_each(|i| groups.entry(key(i)).or_default().push(i));
    groups.into_values().collect()
}

fn centre<'a>(values: &mut [f64], groups: impl Iterator<Item = &'a Vec<usize>>) {
    for group in groups {
        let middle = group.iter().map(|i| values[*i]).sum::<f64>() / group.len() as f64;
        group.iter().for_each(|i| values[*i] -= middle);
    }
}
