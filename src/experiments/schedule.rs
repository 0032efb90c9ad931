//! Load schedules of axis tests.

use crate::ground::problem::{Outcome, Problem};

/// A load schedule: relative load (−1..1) over relative time of one cycle, cycle by cycle.
#[derive(Debug, Clone, Copy)]
pub struct Schedule {
    /// Its name.
    pub name: &'static str,
    /// What it does, one sentence.
    pub about: &'static str,
    /// Relative amplitude of cycle i of n.
    amplitude: fn(usize, usize) -> f64,
    /// Relative duration of cycle i of n.
    duration: fn(usize, usize) -> f64,
    /// Relative load at relative time 0..1 of a cycle.
    shape: fn(f64) -> f64,
    /// Constant load added, relative.
    preload: f64,
}

/// Every schedule the laboratory knows.
pub const SCHEDULES: &[Schedule] = &[
    Schedule {
        name: "constant",
        about: "repeat the same cycle",
        amplitude: same,
        duration: same,
        shape: triangle,
        preload: 0.0,
    },
    Schedule {
        name: "growing",
        about: "cycles of growing amplitude",
        amplitude: growing,
        duration: same,
        shape: triangle,
        preload: 0.0,
    },
    Schedule {
        name: "holds",
        about: "cycles of growing amplitude with holds at the turning points",
        amplitude: growing,
        duration: same,
        shape: trapezoid,
        preload: 0.0,
    },
    Schedule {
        name: "two-rates",
        about: "the same cycle fast and five times slower",
        amplitude: same,
        duration: two_rates,
        shape: triangle,
        preload: 0.0,
    },
    Schedule {
        name: "rates-and-holds",
        about: "fast and slow cycles of growing amplitude with holds",
        amplitude: growing,
        duration: two_rates,
        shape: trapezoid,
        preload: 0.0,
    },
    Schedule {
        name: "preload",
        about: "cycles on one side of zero, under a preload of half the largest load",
        amplitude: half,
        duration: same,
        shape: triangle,
        preload: 0.5,
    },
];

fn same(_: usize, _: usize) -> f64 {
    1.0
}
fn half(_: usize, _: usize) -> f64 {
    0.48
}
fn growing(i: usize, n: usize) -> f64 {
    (i + 1) as f64 / n as f64
}
fn two_rates(i: usize, n: usize) -> f64 {
    if 2 * i < n { 0.4 } else { 2.0 }
}

/// Rises to 1 at a quarter, falls to −1 at three quarters.
fn triangle(x: f64) -> f64 {
    match x {
        x if x < 0.25 => 4.0 * x,
        x if x < 0.75 => 2.0 - 4.0 * x,
        x => 4.0 * x - 4.0,
    }
}

/// A triangle that stands still at its ends for a fifth of the time each.
fn trapezoid(x: f64) -> f64 {
    (1.65 * triangle(x)).clamp(-1.0, 1.0)
}

/// The schedule with this name.
pub fn named(name: &str) -> Outcome<&'static Schedule> {
    SCHEDULES.iter().find(|s| s.name == name).ok_or_else(|| {
        let known: Vec<_> = SCHEDULES.iter().map(|s| s.name).collect();
        Problem::new(
            format!("no schedule is called `{name}`"),
            format!("choose among: {}", known.join(", ")),
        )
    })
}

impl Schedule {
    /// Time (s) and load over `cycles` cycles of mean duration `cycle_s`, after `rest_s` unloaded,
    /// sampled every `step_s`.
    pub fn history(
        &self,
        cycles: usize,
        cycle_s: f64,
        rest_s: f64,
        step_s: f64,
        largest: f64,
    ) -> (Vec<f64>, Vec<f64>) {
        let starts = self.starts(cycles, cycle_s, rest_s);
        let end = starts.last().copied().unwrap_or(rest_s);
        let rows = (end / step_s).floor() as usize + 1;
        let time: Vec<f64> = (0..rows).map(|i| i as f64 * step_s).collect();
        let load = time
            .iter()
            .map(|t| largest * self.at(*t, &starts, cycles))
            .collect();
        (time, load)
    }

    fn starts(&self, cycles: usize, cycle_s: f64, rest_s: f64) -> Vec<f64> {
        let mut starts = vec![rest_s];
        for i in 0..cycles {
            starts.push(starts[i] + cycle_s * (self.duration)(i, cycles));
        }
        starts
    }

    fn at(&self, t: f64, starts: &[f64], cycles: usize) -> f64 {
        let passed = starts.partition_point(|s| *s <= t);
        if passed == 0 {
            return 0.0;
        }
        let i = (passed - 1).min(cycles.saturating_sub(1));
        let x = ((t - starts[i]) / (starts[i + 1] - starts[i])).clamp(0.0, 1.0);
        let ramp = if i == 0 { (4.0 * x).min(1.0) } else { 1.0 };
        (self.amplitude)(i, cycles) * (self.shape)(x) + self.preload * ramp
    }
}
