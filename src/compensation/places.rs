//! What a correction has reached place by place, and what is tried next at each: where a trial left more
//! than the best one before it, that one comes back and a smaller step is tried.

use super::correction::Correction;
use super::remaining::Station;
use crate::ground::spatial::{V3, norm};

/// What is left counts for the places within this time of it, s: a few swings of a soft robot.
const NEAR_S: f64 = 0.25;
/// Standard deviation of the way from one place that gained to one that did not, s: over less than a swing of the robot, what
/// is mixed of two commands sets one going.
const BLEND_S: f64 = 0.1;

/// What a correction left.
pub(super) struct Trial {
    /// What is left at every station.
    pub(super) stations: Vec<Station>,
    /// What is to be taken away, m, at ascending arc lengths, m.
    pub(super) update: Vec<(f64, V3)>,
}

/// The best that every place has seen.
pub(super) struct Places {
    /// The correction there.
    best: Correction,
    /// The largest deviation near it that it left, m.
    error: Vec<f64>,
    /// What it says is to be taken away, m.
    update: Vec<V3>,
    /// Share of that which is tried.
    share: Vec<f64>,
}

impl Places {
    /// After another trial.
    pub(super) fn next(before: Option<Self>, tried: &Correction, trial: &Trial) -> Self {
        let error = tried.resampled(&near(&trial.stations));
        let error: Vec<f64> = error.iter().map(|e| e[0]).collect();
        let update = tried.smoothed(&trial.update);
        let times = times(tried, &trial.stations);
        match before {
            None => Self {
                share: vec![1.0; error.len()],
                best: tried.clone(),
                error,
                update,
            },
            Some(before) => before.with(tried, &times, (&error, &update)),
        }
    }

    fn with(mut self, tried: &Correction, times: &[f64], (error, update): (&[f64], &[V3])) -> Self {
        let pairs = error.iter().zip(&self.error);
        let gained: Vec<f64> = pairs
            .map(|(new, old)| f64::from(u8::from(new <= old)))
            .collect();
        for (i, gained) in blended(&gained, times).into_iter().enumerate() {
            let mix = |old: f64, new: f64| old + gained * (new - old);
            self.best.mix(i, tried, gained);
            self.error[i] = mix(self.error[i], error[i]);
            self.update[i] = [0, 1, 2].map(|k| mix(self.update[i][k], update[i][k]));
            self.share[i] = (self.share[i] * mix(0.5, 2.0)).min(1.0);
        }
        self
    }

    /// What is tried next.
    pub(super) fn candidate(&self) -> Correction {
        self.best.without(&self.update, &self.share)
    }

    /// The largest step that is tried next, m.
    pub(super) fn step_m(&self) -> f64 {
        let steps = self.share.iter().zip(&self.update);
        steps
            .map(|(share, step)| share * norm(*step))
            .fold(0.0, f64::max)
    }
}

/// When the tool is at every station of a correction, s, ascending.
fn times(tried: &Correction, stations: &[Station]) -> Vec<f64> {
    let mut ascending: Vec<(f64, V3)> = Vec::new();
    for station in stations {
        if ascending.last().is_none_or(|last| station.s_m > last.0) {
            ascending.push((station.s_m, [station.time_s, 0.0, 0.0]));
        }
    }
    let mut latest = 0.0_f64;
    let each = tried.resampled(&ascending).into_iter();
    each.map(|[time, ..]| {
        latest = latest.max(time);
        latest
    })
    .collect()
}

/// Values smoothed over time by a bell of [`BLEND_S`].
fn blended(values: &[f64], times: &[f64]) -> Vec<f64> {
    /// Standard deviations after which a bell is nothing.
    const REACH: f64 = 4.0;
    /// Duration of a station at which the time stands, s.
    const LEAST: f64 = 1e-9;
    let last = times.len().saturating_sub(1);
    let lasts = |i: usize| 0.5 * (times[(i + 1).min(last)] - times[i.saturating_sub(1)]) + LEAST;
    let mut first = 0;
    let mean = |i: usize| {
        while times[first] < times[i] - REACH * BLEND_S {
            first += 1;
        }
        let near = (first..values.len()).take_while(|j| times[*j] <= times[i] + REACH * BLEND_S);
        let weighed = near.map(|j| {
            let far = (times[j] - times[i]) / BLEND_S;
            (lasts(j) * (-0.5 * far * far).exp(), values[j])
        });
        let sums = weighed.fold([0.0; 2], |[all, sum], (w, v)| [all + w, sum + w * v]);
        sums[1] / sums[0]
    };
    (0..values.len()).map(mean).collect()
}

/// The largest deviation of the cut near every station, by arc length; nothing where no cut is near.
fn near(stations: &[Station]) -> Vec<(f64, V3)> {
    let mut falling: std::collections::VecDeque<usize> = Default::default();
    let (mut next, mut out) = (0, Vec::<(f64, V3)>::new());
    let size = |i: usize| norm(stations[i].left);
    for station in stations {
        while next < stations.len() && stations[next].time_s <= station.time_s + NEAR_S {
            if stations[next].cutting {
                while falling.back().is_some_and(|i| size(*i) <= size(next)) {
                    falling.pop_back();
                }
                falling.push_back(next);
            }
            next += 1;
        }
        let past = |i: &usize| stations[*i].time_s < station.time_s - NEAR_S;
        while falling.front().is_some_and(past) {
            falling.pop_front();
        }
        if out.last().is_none_or(|last| station.s_m > last.0) {
            let largest = falling.front().map_or(0.0, |i| size(*i));
            out.push((station.s_m, [largest, 0.0, 0.0]));
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn station(i: usize, left: f64) -> Station {
        let s = 1e-3 * i as f64;
        Station {
            time_s: 100.0 * s,
            s_m: s,
            at: [s, 0.0, 0.0],
            left: [0.0, left, 0.0],
            cutting: true,
        }
    }

    fn trial(left: impl Fn(usize) -> f64) -> Trial {
        let stations: Vec<Station> = (0..100).map(|i| station(i, left(i))).collect();
        Trial {
            update: stations.iter().map(|s| (s.s_m, s.left)).collect(),
            stations,
        }
    }

    #[test]
    fn what_grew_is_taken_back_and_the_rest_goes_on() {
        let none = Correction::none(0.099);
        let one = Places::next(None, &none, &trial(|_| 1e-4));
        let tried = one.candidate();
        assert!((tried.at(0.05)[1] + 1e-4).abs() < 1e-9);
        let second = trial(|i| if i < 50 { 1e-5 } else { 3e-4 });
        let two = Places::next(Some(one), &tried, &second).candidate();
        assert!(
            (two.at(0.02)[1] + 1.1e-4).abs() < 1e-7,
            "{:?}",
            two.at(0.02)
        );
        assert!(
            (two.at(0.08)[1] + 0.5e-4).abs() < 1e-7,
            "{:?}",
            two.at(0.08)
        );
    }
}
