//! What corrections left, and what is tried next: near each time the mix of all that were tried which leaves
//! least, and what that still leaves taken away.
//!
//! A trial tells what robot and cut answer, whatever the model of the answer says: for small corrections both are
//! nearly linear, so that a mix of corrections (weights that sum to one) leaves the mix of what each of them left. The
//! weights of least squares make this a quasi-Newton method that knows as many directions as there were trials (Anderson 1965).

use super::correction::Correction;
use super::remaining::{Station, ascending};
use crate::ground::spatial::{V3, add, scale, sub};
use crate::ground::vector::dot;
use nalgebra::{DMatrix, DVector};

/// Standard deviation of the time over which one mix holds, s: over less than a swing of the robot what is mixed of two
/// commands sets one going; over much more one mix has to serve too many places. From 0.12 to 0.25 s seven straight cuts,
/// corners, arcs and ramps end alike; with 0.8 s an arc keeps 0.21 mm instead of 0.08.
const NEAR_S: f64 = 0.15;
/// Step of the times at which mixes are found, s.
const STEP_S: f64 = 0.02;
/// What the weights give away to stay small, as a share of the mean square that trials left: a tenth of it changes
/// little, ten times as much keeps an arc at 0.21 mm as well.
const CALM: f64 = 1e-3;

/// What a correction left.
pub(super) struct Trial {
    /// What is left at every station.
    pub(super) stations: Vec<Station>,
    /// What is to be taken away, m, at ascending arc lengths, m.
    pub(super) update: Vec<(f64, V3)>,
}

/// What a correction that was tried says, by its stations.
struct Tried {
    /// What it left in the cut, m.
    left: Vec<V3>,
    /// What the correction would be by this trial alone, m.
    next: Vec<V3>,
}

/// All that was tried.
#[derive(Default)]
pub(super) struct Trials {
    tried: Vec<Tried>,
    /// When the tool is at every station, s from the begin of the motion, ascending.
    times: Vec<f64>,
}

impl Trials {
    /// Takes another one; what is tried next.
    pub(super) fn after(&mut self, tried: &Correction, trial: &Trial) -> Correction {
        self.times = times(tried, &trial.stations);
        let update = tried.smoothed(&trial.update);
        let next = tried.values().iter().zip(update);
        let left = |station: &Station| match station.cutting {
            true => (station.s_m, station.left),
            false => (station.s_m, [0.0; 3]),
        };
        let left: Vec<(f64, V3)> = ascending(&trial.stations).map(left).collect();
        self.tried.push(Tried {
            left: tried.resampled(&left),
            next: next.map(|(value, update)| sub(*value, update)).collect(),
        });
        tried.with(self.mixed())
    }

    /// The mix at every station, m.
    fn mixed(&self) -> Vec<V3> {
        let weights = self.weights();
        let value = |(i, time): (usize, &f64)| {
            let each = self
                .tried
                .iter()
                .zip(between(&weights, (time / STEP_S - 0.5).max(0.0)));
            each.fold([0.0; 3], |sum, (tried, weight)| {
                add(sum, scale(weight, tried.next[i]))
            })
        };
        self.times.iter().enumerate().map(value).collect()
    }

    /// The weights of all trials, one list per [`STEP_S`].
    fn weights(&self) -> Vec<DVector<f64>> {
        let products = near(&self.products());
        products.iter().map(weights).collect()
    }

    /// Products of what trials left, summed over each [`STEP_S`], m² s.
    fn products(&self) -> Vec<DMatrix<f64>> {
        let count = self.tried.len();
        let bin = |time: f64| (time / STEP_S) as usize;
        let bins = self.times.last().map_or(0, |t| bin(*t)) + 1;
        let mut sums = vec![DMatrix::zeros(count, count); bins];
        for (i, time) in self.times.iter().enumerate() {
            let lasts = time - self.times[i.saturating_sub(1)];
            let product = |a: usize, b: usize| dot(self.tried[a].left[i], self.tried[b].left[i]);
            sums[bin(*time)] += DMatrix::from_fn(count, count, product) * lasts;
        }
        sums
    }
}

/// The weights, summing to one, of the mix that leaves least; where nothing is cut the last trial stands.
fn weights(products: &DMatrix<f64>) -> DVector<f64> {
    let count = products.nrows();
    let calm = CALM * products.trace() / count as f64;
    let calmed = products + DMatrix::identity(count, count) * calm;
    let solved = calmed.cholesky();
    let solved = solved.map(|c| c.solve(&DVector::from_element(count, 1.0)));
    match solved.map(|w| (w.sum(), w)) {
        Some((sum, weights)) if sum.is_finite() && sum > 0.0 => weights / sum,
        _ => DVector::from_fn(count, |i, _| f64::from(u8::from(i + 1 == count))),
    }
}

/// Sums over a bell of [`NEAR_S`].
fn near(products: &[DMatrix<f64>]) -> Vec<DMatrix<f64>> {
    /// Standard deviations after which a bell is nothing.
    const REACH: f64 = 4.0;
    let reach = (REACH * NEAR_S / STEP_S).ceil() as usize;
    let sum = |i: usize| {
        let places = i.saturating_sub(reach)..(i + reach + 1).min(products.len());
        let none = DMatrix::zeros(products[i].nrows(), products[i].ncols());
        places.fold(none, |sum, j| {
            let far = STEP_S * (j as f64 - i as f64) / NEAR_S;
            sum + &products[j] * (-0.5 * far * far).exp()
        })
    };
    (0..products.len()).map(sum).collect()
}

/// Linear between lists.
fn between(lists: &[DVector<f64>], at: f64) -> Vec<f64> {
    let last = lists.len() - 1;
    let i = (at as usize).min(last);
    let share = (at - i as f64).clamp(0.0, 1.0);
    let pairs = lists[i].iter().zip(&lists[(i + 1).min(last)]);
    pairs.map(|(a, b)| a + share * (b - a)).collect()
}

/// When the tool is at every station of a correction, s from the begin.
fn times(tried: &Correction, stations: &[Station]) -> Vec<f64> {
    let first = stations.first().map_or(0.0, |s| s.time_s);
    let time = |station: &Station| (station.s_m, [station.time_s - first, 0.0, 0.0]);
    let times: Vec<(f64, V3)> = ascending(stations).map(time).collect();
    let mut latest = 0.0_f64;
    let each = tried.resampled(&times).into_iter();
    each.map(|[time, ..]| {
        latest = latest.max(time);
        latest
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a correction leaves of a deviation of 0.1 mm where the tip answers it too strongly in the first half, too weakly in the second.
    fn trial(tried: &Correction) -> Trial {
        let station = |i: usize| {
            let s = 1e-3 * i as f64;
            let answer = if i < 200 { 1.8 } else { 0.4 };
            Station {
                time_s: 3.0 + 20.0 * s,
                s_m: s,
                at: [s, 0.0, 0.0],
                left: [0.0, 1e-4 + answer * tried.at(s)[1], 0.0],
                cutting: true,
            }
        };
        let stations: Vec<Station> = (0..400).map(station).collect();
        Trial {
            update: stations.iter().map(|s| (s.s_m, s.left)).collect(),
            stations,
        }
    }

    #[test]
    fn what_trials_answered_tells_the_step_at_each_place() {
        let none = Correction::none(0.399);
        let mut trials = Trials::default();
        let one = trials.after(&none, &trial(&none));
        assert!((one.at(0.1)[1] + 1e-4).abs() < 1e-9);
        let two = trials.after(&one, &trial(&one));
        let three = trials.after(&two, &trial(&two));
        for (s, right) in [(0.05, -1e-4 / 1.8), (0.35, -1e-4 / 0.4)] {
            assert!(
                (three.at(s)[1] / right - 1.0).abs() < 0.02,
                "{:?}",
                three.at(s)
            );
        }
    }

    #[test]
    fn where_nothing_is_cut_the_last_trial_stands() {
        assert_eq!(weights(&DMatrix::zeros(3, 3)).as_slice(), [0.0, 0.0, 1.0]);
    }
}
