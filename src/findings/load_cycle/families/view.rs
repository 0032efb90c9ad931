//! A record as the families see it: load, time and turning points in natural units.

use super::jumps::{Jumps, jumps, left};
use crate::fit::observation::Observation;
use crate::signal::play::play;
use crate::signal::steps::goes_in_steps;

/// Load and time of a record without units.
pub struct View {
    /// Load over the largest.
    pub u: Vec<f64>,
    /// The same as it was read, where it is taken for smoother than that.
    pub read: Vec<f64>,
    /// Time over the duration, 0 to 1.
    pub t: Vec<f64>,
    /// Duration of a cycle over that of the record.
    pub period: f64,
    /// Duration of a row over that of the record.
    pub row: f64,
    /// Half cycle of every row: counts turning points.
    pub half_cycle: Vec<usize>,
    /// Stroke of every row: counts how often the load left zero, from where it was nearest to that.
    pub stroke: Vec<usize>,
    /// Whether the load takes both signs.
    pub two_sided: bool,
    /// Whether the load jumps from level to level (dead weights): delays of less than a few rows cannot be seen there.
    pub stepped: bool,
    /// Whether the record starts under load: what came before is unknown.
    pub loaded_start: bool,
    /// Share of the band of the rows, averaged as they are, that is the lower quarter of the readings' own:
    /// what oscillates above is folded mains, below something that moves.
    pub slow: f64,
    /// Where the reading jumps, whatever the load does.
    pub jumps: Jumps,
}

/// Share of the larger side that the smaller must reach for a load to count as two-sided.
const OTHER_SIDE: f64 = 0.2;
/// Load at the first row beyond which the record starts under load.
const LOADED: f64 = 0.05;
/// See [`View::slow`].
const SLOW: f64 = 0.25;
/// What a column must hold beside the spring to count.
const BESIDE: f64 = 1e-4;

impl View {
    /// Of reduced data.
    pub fn of(data: &Observation) -> Self {
        let scale = data.scene.load_scale;
        let u: Vec<f64> = data.scene.load.iter().map(|m| m / scale).collect();
        let read = data.read.as_ref().unwrap_or(&data.scene.load);
        let first = data.scene.time.first().copied().unwrap_or(0.0);
        let t = data.scene.time.iter();
        let t: Vec<f64> = t.map(|t| (t - first) / data.scene.duration).collect();
        let (low, high) = u
            .iter()
            .fold((0.0_f64, 0.0_f64), |(l, h), v| (l.min(*v), h.max(*v)));
        Self {
            read: read.iter().map(|m| m / scale).collect(),
            jumps: jumps(&u, &t, &data.reading),
            row: 1.0 / t.len().saturating_sub(1).max(1) as f64,
            t,
            period: data.scene.period / data.scene.duration,
            half_cycle: half_cycles(&data.cycles.turning, u.len()),
            stroke: strokes(&u),
            two_sided: high.min(-low) > OTHER_SIDE * high.max(-low),
            stepped: goes_in_steps(&u),
            slow: (SLOW * data.block as f64).min(1.0),
            loaded_start: u.first().is_some_and(|v| v.abs() > LOADED),
            u,
        }
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.u.len()
    }

    /// Sign of the largest load.
    pub fn side(&self) -> f64 {
        let largest = self
            .u
            .iter()
            .fold(0.0_f64, |m, u| if u.abs() > m.abs() { *u } else { m });
        1.0_f64.copysign(largest)
    }

    /// A column less what the spring takes of it. `None` where nothing is left.
    pub fn beyond_spring(&self, column: &[f64]) -> Option<Vec<f64>> {
        let own: f64 = self.u.iter().map(|u| u * u).sum();
        let cross: f64 = self.u.iter().zip(column).map(|(u, c)| u * c).sum();
        let slope = cross / own.max(f64::MIN_POSITIVE);
        let rows = column.iter().zip(&self.u);
        let left: Vec<f64> = rows.map(|(c, u)| c - slope * u).collect();
        let square = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>();
        let kept = square(&left) > BESIDE * BESIDE * square(column);
        (kept && square(&left).is_finite()).then_some(left)
    }

    /// Whether the load begins and ends near zero.
    pub fn comes_back(&self) -> bool {
        let ends = [self.u.first(), self.u.last()];
        ends.into_iter().flatten().all(|u| u.abs() < LOADED)
    }

    /// Work that the load does on a column, load by deflection.
    pub fn work(&self, column: &[f64]) -> f64 {
        let steps = self.u.windows(2).zip(column.windows(2));
        steps
            .map(|(u, c)| 0.5 * (u[0] + u[1]) * (c[1] - c[0]))
            .sum()
    }

    /// A function of the load.
    pub fn over_load(&self, f: impl Fn(f64) -> f64) -> Vec<f64> {
        self.u.iter().map(|u| f(*u)).collect()
    }

    /// A function of time.
    pub fn over_time(&self, f: impl Fn(f64) -> f64) -> Vec<f64> {
        self.t.iter().map(|t| f(*t)).collect()
    }

    /// What the spring, curves of the load and a straight course of time leave of readings.
    pub fn left(&self, reading: &[f64]) -> Vec<f64> {
        left(&self.u, &self.t, reading)
    }

    /// One from a row on, nought before.
    pub fn since(&self, row: usize) -> Vec<f64> {
        (0..self.rows())
            .map(|i| f64::from(u8::from(i >= row)))
            .collect()
    }

    /// The load behind a play of this half width: it follows once the play is taken up (from rest in its
    /// middle).
    pub fn played(&self, half_width: f64) -> Vec<f64> {
        play(&self.u, half_width)
    }

    /// The load behind a first-order lag of this share of the duration, from rest.
    pub fn lagged(&self, tau: f64) -> Vec<f64> {
        let mut state = 0.0;
        let mut out = Vec::with_capacity(self.rows());
        for i in 0..self.rows() {
            if i > 0 {
                let x = (self.t[i] - self.t[i - 1]) / tau;
                let keep = (-x).exp();
                // exact for a load that is straight between rows
                let mean = if x > 1e-9 { (1.0 - keep) / x } else { 1.0 };
                let (a, b) = (self.u[i - 1], self.u[i]);
                state = keep * state + a * (mean - keep) + b * (1.0 - mean);
            }
            out.push(state);
        }
        out
    }

    /// The load as it was `delay` (share of the duration) earlier, less the load.
    pub fn delayed(&self, delay: impl Fn(f64) -> f64) -> Vec<f64> {
        let at = |i: usize| interpolate(&self.t, &self.u, self.t[i] - delay(self.t[i])) - self.u[i];
        (0..self.rows()).map(at).collect()
    }
}

fn interpolate(x: &[f64], y: &[f64], at: f64) -> f64 {
    crate::measurement::load_cycle::interpolate(x, y, at)
}

fn half_cycles(turning: &[usize], rows: usize) -> Vec<usize> {
    (0..rows)
        .map(|i| turning.iter().filter(|t| **t <= i).count())
        .collect()
}

/// Every stroke begins in the row nearest to zero between two stretches of load.
fn strokes(u: &[f64]) -> Vec<usize> {
    let mut begins = vec![0; u.len()];
    let mut last: Option<usize> = None;
    for i in (0..u.len()).filter(|i| u[*i].abs() > LOADED) {
        let from = last.map_or(i, |before| before + 1);
        let nearest = (from..=i).min_by(|a, b| u[*a].abs().total_cmp(&u[*b].abs()));
        let nearest = nearest.unwrap_or(i);
        // a load that trembles about the border has not been at zero
        if last.is_some_and(|before| u[before] * u[i] < 0.0 || u[nearest].abs() < 0.5 * LOADED) {
            begins[nearest] = 1;
        }
        last = Some(i);
    }
    begins
        .iter()
        .scan(0, |count, begins| {
            *count += begins;
            Some(*count)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ground::random::Random;

    #[test]
    fn a_stroke_begins_where_the_load_is_nearest_to_zero() {
        let mut random = Random::new(2);
        let tremble = 0.01;
        let sine = |i: usize| (std::f64::consts::TAU * i as f64 / 750.0).sin();
        let both: Vec<f64> = (0..2250)
            .map(|i| sine(i) + tremble * random.normal())
            .collect();
        let found = strokes(&both);
        assert_eq!(found[2249], 5);
        let begins = |k: usize| found.iter().position(|s| *s == k).unwrap() as f64;
        (1..6).for_each(|k| assert!((begins(k) - 375.0 * k as f64).abs() < 8.0));
        let one: Vec<f64> = both.iter().map(|u| u.abs()).collect();
        assert_eq!(strokes(&one)[2249], 5);
        assert!(strokes(&[1.0; 20]).iter().all(|s| *s == 0));
    }
}
