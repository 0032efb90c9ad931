//! Programmes of load: what a crane, a cylinder, a spindle or a stack of weights does to an arm over a day.

use super::super::{chance, pick};
use ident::ground::random::Random;
use std::f64::consts::PI;

/// True load (1: its largest) on a fine raster of time, and which places of the raster were read.
#[derive(Debug, Clone)]
pub struct Programme {
    pub t: Vec<f64>,
    pub u: Vec<f64>,
    pub rows: Vec<usize>,
    pub name: String,
    /// Loads of both signs.
    pub two_sided: bool,
    /// Only read while the load stood still.
    pub standing: bool,
    pub even: bool,
    pub rest: f64,
}

/// Levels to go to one after the other, each with how long it is held (1: the way from 0 to the largest load).
fn levels(kind: usize, cycles: usize, random: &mut Random) -> (Vec<[f64; 2]>, &'static str) {
    let hold = random.uniform(0.3, 2.0);
    let mut all = Vec::new();
    let low = -random.uniform(0.25, 0.8);
    let small = random.uniform(0.25, 0.6);
    let steps = 3 + random.below(5);
    for c in 0..cycles {
        let part = (c + 1) as f64 / cycles as f64;
        match kind {
            0 | 3 => all.extend([[1.0, 0.0], [-1.0, 0.0]]),
            1 => all.extend([[part, 0.0], [-part, 0.0]]),
            2 => all.extend([
                [1.0, hold],
                [0.0, 0.5 * hold],
                [-1.0, hold],
                [0.0, 0.5 * hold],
            ]),
            4 | 5 => {
                let way = |s: f64| {
                    (1..=2 * steps)
                        .map(move |i| s * (steps as f64 - i.abs_diff(steps) as f64) / steps as f64)
                };
                all.extend(way(1.0).map(|l| [l, 1.0]));
                if kind == 5 {
                    all.extend(way(-1.0).map(|l| [l, 1.0]));
                }
            }
            6 => all.extend((0..8).map(|_| [random.uniform(-1.0, 1.0), random.uniform(0.2, 1.5)])),
            7 => all.extend([[1.0, 0.2 * hold], [low, 0.0]]),
            8 => all.extend([[1.0, 0.0], [-1.0, 0.0], [small, 0.3 * hold], [-small, 0.0]]),
            _ => all.extend([[1.0, 0.0], [0.0, 0.1]]),
        }
    }
    let top = all.iter().map(|l| l[0].abs()).fold(0.0, f64::max);
    all.iter_mut().for_each(|l| l[0] /= top);
    if all[all.len() - 1][0] != 0.0 {
        all.push([0.0, 0.1]);
    }
    let names = [
        "triangle",
        "growing",
        "trapezoid",
        "sine",
        "weights one way",
        "weights both ways",
        "random holds",
        "asymmetric",
        "two amplitudes",
        "one-sided",
    ];
    (all, names[kind])
}

/// Corners of the programme, and for every hold its beginning and end.
type Corners = (Vec<[f64; 2]>, Vec<[f64; 2]>);

fn corners(levels: &[[f64; 2]], rest: f64, rates: bool, random: &mut Random) -> Corners {
    let mut knots = vec![[0.0, 0.0], [rest, 0.0]];
    let mut holds = vec![[0.0, rest]];
    let (mut time, mut at) = (rest, 0.0_f64);
    for (i, [level, hold]) in levels.iter().enumerate() {
        let rate = if rates && i >= levels.len() / 2 {
            random.uniform(2.0, 4.0)
        } else {
            1.0
        };
        time += (level - at).abs().max(0.05) / rate;
        knots.push([time, *level]);
        holds.push([time, time + hold]);
        if *hold > 0.0 {
            time += hold;
            knots.push([time, *level]);
        }
        at = *level;
    }
    (knots, holds)
}

fn load(knots: &[[f64; 2]], round: bool, t: f64) -> f64 {
    let after = knots
        .partition_point(|k| k[0] < t)
        .clamp(1, knots.len() - 1);
    let ([t0, u0], [t1, u1]) = (knots[after - 1], knots[after]);
    let share = ((t - t0) / (t1 - t0).max(1e-12)).clamp(0.0, 1.0);
    let share = if round {
        0.5 - 0.5 * (PI * share).cos()
    } else {
        share
    };
    u0 + (u1 - u0) * share
}

/// Instants of the readings.
fn instants(
    standing: bool,
    even: bool,
    rows: usize,
    (knots, holds): &Corners,
    random: &mut Random,
) -> Vec<f64> {
    let last = knots[knots.len() - 1][0];
    if standing {
        let each = (rows / holds.len()).clamp(1, 8);
        let read = |h: &[f64; 2]| {
            (0..each)
                .map(move |i| h[0] + (h[1] - h[0]) * (0.6 + 0.39 * i as f64 / each as f64))
                .collect::<Vec<_>>()
        };
        return holds
            .iter()
            .filter(|h| h[1] > h[0])
            .flat_map(read)
            .collect();
    }
    let step = last / (rows - 1) as f64;
    let jitter = if even { 0.0 } else { 0.45 };
    let at = |i: usize| (i as f64 + jitter * random.uniform(-1.0, 1.0)) * step;
    (0..rows).map(at).map(|t| t.clamp(0.0, last)).collect()
}

impl Programme {
    /// One by chance.
    pub fn draw(random: &mut Random) -> Self {
        let kind = random.below(10);
        // Up once and down once is refused by the contract (too few turns): two cycles at least under loads of one sign.
        let least = if matches!(kind, 4 | 9) { 2 } else { 1 };
        let cycles = least + random.below(7 - least);
        let (levels, name) = levels(kind, cycles, random);
        let standing = matches!(kind, 4 | 5) && chance(random, 0.7);
        let rest = if chance(random, 0.75) {
            random.uniform(0.3, 1.5)
        } else {
            0.02
        };
        let rates = !standing && chance(random, 0.25);
        let corners = corners(&levels, rest, rates, random);
        let least = if standing {
            25
        } else {
            (36 * cycles).max(6 * levels.len())
        };
        let rows = random.log_uniform(least as f64, 4000.0_f64.min(60.0 * least as f64)) as usize;
        let even = standing || chance(random, 0.7);
        let read = instants(standing, even, rows, &corners, random);
        let seconds = *pick(random, &[2.0, 5.0, 12.0, 30.0, 60.0]);
        let round = kind == 3 || (!standing && chance(random, 0.15));
        let mut all = Self::raster(&corners.0, round, &read);
        all.t.iter_mut().for_each(|t| *t *= seconds);
        let pace = if rates { ", two rates" } else { "" };
        let raster = if even { "" } else { ", uneven" };
        all.name = format!("{name} x{cycles}, {} rows{raster}{pace}", all.rows.len());
        all.two_sided = all.u.iter().copied().fold(0.0, f64::min) < -0.2;
        (all.standing, all.even, all.rest) = (standing, even, rest * seconds);
        all
    }

    fn raster(knots: &[[f64; 2]], round: bool, read: &[f64]) -> Self {
        let last = knots[knots.len() - 1][0];
        let mut marks: Vec<(f64, bool)> = (0..3000)
            .map(|i| (last * f64::from(i) / 2999.0, false))
            .collect();
        marks.extend(knots.iter().map(|k| (k[0], false)));
        marks.extend(read.iter().map(|t| (*t, true)));
        marks.sort_by(|a, b| a.0.total_cmp(&b.0));
        Self {
            t: marks.iter().map(|m| m.0).collect(),
            u: marks.iter().map(|m| load(knots, round, m.0)).collect(),
            rows: (0..marks.len()).filter(|i| marks[*i].1).collect(),
            name: String::new(),
            two_sided: false,
            standing: false,
            even: false,
            rest: 0.0,
        }
    }

    /// What was read of a course on the raster.
    pub fn read(&self, fine: &[f64]) -> Vec<f64> {
        self.rows.iter().map(|i| fine[*i]).collect()
    }

    /// Duration, s.
    pub fn last(&self) -> f64 {
        self.t[self.t.len() - 1]
    }

    /// A function of the load on the raster.
    pub fn of_load(&self, f: impl Fn(f64) -> f64) -> Vec<f64> {
        self.u.iter().map(|u| f(*u)).collect()
    }

    /// A function of the time on the raster, 0 at the beginning to 1 at the end.
    pub fn of_time(&self, f: impl Fn(f64) -> f64) -> Vec<f64> {
        self.t.iter().map(|t| f(t / self.last())).collect()
    }

    /// The load that was, so many seconds ago.
    pub fn before(&self, delay: f64) -> Vec<f64> {
        let at = |t: &f64| {
            let t = t - delay;
            let after = self
                .t
                .partition_point(|x| *x < t)
                .clamp(1, self.t.len() - 1);
            let (t0, t1) = (self.t[after - 1], self.t[after]);
            let share = ((t - t0) / (t1 - t0).max(1e-12)).clamp(0.0, 1.0);
            self.u[after - 1] + share * (self.u[after] - self.u[after - 1])
        };
        self.t.iter().map(at).collect()
    }

    /// Way that the load has gone, 1 at the end.
    pub fn work(&self) -> Vec<f64> {
        let mut all = vec![0.0];
        for pair in self.u.windows(2) {
            all.push(all[all.len() - 1] + (pair[1] - pair[0]).abs());
        }
        let whole = all[all.len() - 1];
        all.iter().map(|w| w / whole).collect()
    }
}
