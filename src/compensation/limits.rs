//! How sure it is what will be left, which number limits that, and what would lower it most.

use super::drawn::Drawn;
use super::draws::Draws;
use super::remaining::Station;
use crate::ground::problem::Outcome;
use crate::ground::spatial::{V3, add, norm, sub};
use crate::ground::stats::descending;
use crate::path::Path;
use crate::process::setup::Setup;
use crate::process::uncertainty::{Doubt, Moved};
use std::collections::BTreeMap;

/// What an uncertain number does to what is left.
#[derive(Debug, Clone, PartialEq)]
pub struct Limit {
    /// The number.
    pub doubt: Doubt,
    /// Largest change of the deviation by one standard deviation of it, m.
    pub change_m: f64,
    /// Upper end of the interval if it were known exactly, m.
    pub high_without_m: f64,
}

/// What would be measured next.
#[derive(Debug, Clone, PartialEq)]
pub struct Next {
    /// The measurement, imperative.
    pub what: String,
    /// Upper end of the interval after it, m.
    pub high_after_m: f64,
}

/// How sure it is what will be left.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Certainty {
    /// 95 % interval of the largest deviation, m; `None`: nothing states how well it is known.
    pub ci95: Option<[f64; 2]>,
    /// What it will not exceed in 999 of 1000 cases, m.
    pub at_most_m: Option<f64>,
    /// The uncertain numbers, the most limiting one first.
    pub limits: Vec<Limit>,
    /// What lowers the upper end most.
    pub next: Option<Next>,
}

/// Most stations of an interval, and of either kind of the ranking of numbers.
const STATIONS: usize = 1500;
const RANKED: usize = 200;

/// How sure the model is of what its corrected job leaves. `corrected`: the model on the corrected path;
/// `path`: the programmed one; `moved`: the former with every doubt moved; `left`: what it leaves.
///
/// # Errors
/// A pose that the robot cannot have.
pub fn certainty(
    corrected: &Setup,
    path: &Path,
    moved: &Moved,
    left: &[Station],
) -> Outcome<Certainty> {
    let cutting: Vec<&Station> = left.iter().filter(|s| s.cutting).collect();
    let doubts = moved.doubts();
    if doubts.is_empty() || cutting.is_empty() {
        return Ok(Certainty::default());
    }
    let chosen = thinned(cutting);
    let times: Vec<f64> = chosen.iter().map(|s| s.time_s).collect();
    let mut changes = moved.changes(corrected, &times)?;
    let drawn = Drawn::of(path);
    for (i, station) in chosen.iter().enumerate() {
        for list in &mut changes {
            let left = drawn.left(station.s_m, add(station.at, list[i]));
            list[i] = sub(left, station.left);
        }
    }
    let left: Vec<V3> = chosen.iter().map(|s| s.left).collect();
    let draws = Draws::of(doubts.len());
    let likely = draws.intervals(&left, &changes, &[vec![]])[0];
    let (limits, next) = ranked(doubts, &draws, farthest(&left, &changes));
    Ok(Certainty {
        ci95: likely.map(|l| l.ci95),
        at_most_m: likely.map(|l| l.at_most),
        limits,
        next,
    })
}

/// Every so many stations, the worst of each stretch.
fn thinned(cutting: Vec<&Station>) -> Vec<&Station> {
    let every = cutting.len().div_ceil(STATIONS).max(1);
    let worst = |stretch: &[&Station]| {
        let own = stretch
            .iter()
            .max_by(|a, b| norm(a.left).total_cmp(&norm(b.left)));
        own.map_or(0, |own| stretch.iter().position(|s| s == own).unwrap_or(0))
    };
    cutting.chunks(every).map(|c| c[worst(c)]).collect()
}

/// The stations that may lie farthest off and, whatever is known, those that do, and what the doubts change there.
fn farthest(left: &[V3], changes: &[Vec<V3>]) -> (Vec<V3>, Vec<Vec<V3>>) {
    let reach = |i: usize| norm(left[i]) + 2.0 * root(changes.iter().map(|c| norm(c[i])));
    let first = |by: &dyn Fn(usize) -> f64| {
        let mut order = descending(&(0..left.len()).map(by).collect::<Vec<f64>>());
        order.truncate(RANKED);
        order
    };
    let mut order = [first(&reach), first(&|i| norm(left[i]))].concat();
    order.sort_unstable();
    order.dedup();
    let few = |list: &[V3]| order.iter().map(|i| list[*i]).collect::<Vec<V3>>();
    (few(left), changes.iter().map(|c| few(c)).collect())
}

/// The measurements that would help, each with the numbers that it tells.
fn measurements(doubts: &[Doubt]) -> BTreeMap<String, Vec<usize>> {
    let mut all = BTreeMap::<String, Vec<usize>>::new();
    for (k, doubt) in doubts.iter().enumerate() {
        all.entry(doubt.measured_by()).or_default().push(k);
    }
    all
}

/// Numbers by what knowing them would do, and the measurement that would do most.
fn ranked(
    doubts: &[Doubt],
    draws: &Draws,
    (left, changes): (Vec<V3>, Vec<Vec<V3>>),
) -> (Vec<Limit>, Option<Next>) {
    let told = measurements(doubts);
    let each = (0..doubts.len()).map(|k| vec![k]);
    let known: Vec<Vec<usize>> = each.chain(told.values().cloned()).collect();
    let least = left.iter().map(|v| norm(*v)).fold(0.0, f64::max);
    let likely = draws.intervals(&left, &changes, &known);
    let high = likely.iter().map(|l| l.map_or(least, |l| l.ci95[1]));
    let high: Vec<f64> = high.collect();
    let (alone, together) = high.split_at(doubts.len());
    let limits = doubts.iter().zip(&changes).zip(alone);
    let limits = limits.map(|((doubt, change), high)| Limit {
        change_m: change.iter().map(|v| norm(*v)).fold(0.0, f64::max),
        high_without_m: *high,
        doubt: doubt.clone(),
    });
    let mut limits: Vec<Limit> = limits.collect();
    limits.sort_by(|a, b| a.high_without_m.total_cmp(&b.high_without_m));
    let next = told.into_keys().zip(together);
    let next = next.map(|(what, high)| Next {
        what,
        high_after_m: *high,
    });
    let next = next.min_by(|a, b| a.high_after_m.total_cmp(&b.high_after_m));
    (limits, next)
}

fn root(values: impl Iterator<Item = f64>) -> f64 {
    values.map(|v| v * v).sum::<f64>().sqrt()
}
