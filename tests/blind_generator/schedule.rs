//! Load schedules: what the press does over time, from smooth machines to hand pumps.

use super::random::Random;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Names of the schedules.
pub const SCHEDULES: &[&str] = &[
    "triangle",
    "sine",
    "trapezoid",
    "growing",
    "growing-holds",
    "two-rates",
    "hand-pumped",
    "hand-pumped-growing",
];

/// A load over time on a fine grid; every `stride`-th point is a row of the file.
pub struct Schedule {
    pub name: &'static str,
    pub time: Vec<f64>,
    /// Load over the largest load in the rows.
    pub load: Vec<f64>,
    pub stride: usize,
    /// Load cycle of each row.
    pub cycle: Vec<usize>,
    /// Mean length of a cycle, seconds.
    pub period: f64,
    pub rest: Option<f64>,
}

/// How a segment gets from its first to its last load, as the share done over the share of time.
#[derive(Clone, Copy)]
enum Path {
    Line,
    /// sin: starts fast, arrives at rest.
    Arrive,
    /// 1 - cos: starts from rest.
    Depart,
    /// (1 - cos) / 2 from rest to rest.
    Swing,
    /// Strokes of a hand pump: s - depth sin(2 pi n s) / (2 pi n), monotone for depth < 1.
    Strokes {
        count: f64,
        depth: f64,
    },
}

impl Path {
    fn share(self, s: f64) -> f64 {
        match self {
            Self::Line => s,
            Self::Arrive => (FRAC_PI_2 * s).sin(),
            Self::Depart => 1.0 - (FRAC_PI_2 * s).cos(),
            Self::Swing => 0.5 - 0.5 * (PI * s).cos(),
            Self::Strokes { count, depth } => s - depth * (TAU * count * s).sin() / (TAU * count),
        }
    }
}

struct Segment {
    end: f64,
    from: f64,
    to: f64,
    path: Path,
    cycle: usize,
}

/// What distinguishes the schedules.
struct Style {
    smooth: bool,
    growing: bool,
    hold: f64,
    slow_factor: f64,
    hand: bool,
}

impl Style {
    fn of(name: &str, random: &mut Random) -> Self {
        let growing = name.contains("growing");
        Self {
            smooth: name == "sine" || ((growing || name == "two-rates") && random.chance(0.4)),
            growing,
            hold: match name {
                "trapezoid" => random.uniform(0.05, 0.2),
                "growing-holds" => random.uniform(0.15, 0.4),
                _ => 0.0,
            },
            slow_factor: match name {
                "two-rates" => random.uniform(3.0, 7.0),
                _ => 1.0,
            },
            hand: name.starts_with("hand"),
        }
    }

    fn path(&self, smooth: Path, random: &mut Random) -> Path {
        match (self.hand, self.smooth) {
            (true, _) => Path::Strokes {
                count: random.integer(3, 7) as f64,
                depth: random.uniform(0.5, 0.95),
            },
            (false, true) => smooth,
            (false, false) => Path::Line,
        }
    }
}

/// The segments of a run while they are being strung together.
struct Run {
    segments: Vec<Segment>,
    now: f64,
    load: f64,
}

impl Run {
    fn go(&mut self, to: f64, length: f64, path: Path, cycle: usize) {
        self.now += length;
        self.segments.push(Segment {
            end: self.now,
            from: self.load,
            to,
            path,
            cycle,
        });
        self.load = to;
    }
}

fn cycle_count(random: &mut Random) -> usize {
    match random.unit() {
        x if x < 0.65 => 3,
        x if x < 0.75 => 2,
        x if x < 0.9 => 4,
        _ => 5,
    }
}

fn amplitude(style: &Style, index: usize, count: usize, first: f64, random: &mut Random) -> f64 {
    let share = (index + 1) as f64 / count as f64;
    let planned = match style.growing {
        true => first + (1.0 - first) * (share * count as f64 - 1.0) / (count as f64 - 1.0),
        false => 1.0,
    };
    match style.hand {
        true => planned * random.uniform(0.85, 1.12),
        false => planned,
    }
}

fn string_together(style: &Style, rest: Option<f64>, random: &mut Random) -> Run {
    let mut run = Run {
        segments: Vec::new(),
        now: 0.0,
        load: 0.0,
    };
    if let Some(seconds) = rest {
        run.go(0.0, seconds, Path::Line, 0);
    }
    let (count, base) = (cycle_count(random), random.log_uniform(2.0, 15.0));
    let (first, sign) = (random.uniform(0.25, 0.45), random.sign());
    for index in 0..count {
        let slow = 2 * index + 1 > count;
        let length = base * if slow { style.slow_factor } else { 1.0 };
        let mut pace = || match style.hand {
            true => random.uniform(0.75, 1.3),
            false => 1.0,
        };
        let spans = [
            length / 4.0 * pace(),
            length / 2.0 * pace(),
            length / 4.0 * pace(),
        ];
        let up = sign * amplitude(style, index, count, first, random);
        let down = match style.hand {
            true => -up * random.uniform(0.88, 1.12),
            false => -up,
        };
        run.go(up, spans[0], style.path(Path::Arrive, random), index);
        run.dwell(style.hold * length, index);
        run.go(down, spans[1], style.path(Path::Swing, random), index);
        run.dwell(style.hold * length, index);
        run.go(0.0, spans[2], style.path(Path::Depart, random), index);
    }
    run
}

impl Run {
    fn dwell(&mut self, length: f64, cycle: usize) {
        if length > 0.0 {
            self.go(self.load, length, Path::Line, cycle);
        }
    }

    /// Load and cycle at each of the given rising times.
    fn follow(&self, times: &[f64]) -> (Vec<f64>, Vec<usize>) {
        let (mut at, mut start) = (0, 0.0);
        times
            .iter()
            .map(|&t| {
                while at + 1 < self.segments.len() && t > self.segments[at].end {
                    start = self.segments[at].end;
                    at += 1;
                }
                let segment = &self.segments[at];
                let s = ((t - start) / (segment.end - start)).clamp(0.0, 1.0);
                let load = segment.from + (segment.to - segment.from) * segment.path.share(s);
                (load, segment.cycle)
            })
            .unzip()
    }
}

/// Times of the rows, slightly irregular when a hand pump and a tired logger are at work.
fn row_times(rows: usize, end: f64, jitter: f64, random: &mut Random) -> Vec<f64> {
    let step = end / (rows - 1) as f64;
    (0..rows)
        .map(|i| {
            let wobble = jitter * random.normal_within(3.0);
            let inner = if i == 0 || i + 1 == rows { 0.0 } else { wobble };
            (i as f64 + inner) * step
        })
        .collect()
}

/// Puts `stride - 1` further times between every two rows.
fn refine(rows: &[f64], stride: usize) -> Vec<f64> {
    let inner = rows.windows(2).flat_map(|w| {
        let (from, step) = (w[0], (w[1] - w[0]) / stride as f64);
        (0..stride).map(move |j| from + step * j as f64)
    });
    inner.chain(rows.last().copied()).collect()
}

impl Schedule {
    /// Draws a schedule: the named one, or any.
    pub fn draw(wanted: Option<&'static str>, rows: usize, random: &mut Random) -> Self {
        let name = wanted.unwrap_or_else(|| random.choose(SCHEDULES));
        let style = Style::of(name, random);
        let rest = random.chance(0.5).then(|| random.uniform(0.5, 2.0));
        let run = string_together(&style, rest, random);
        let jitter = if style.hand { 0.08 } else { 0.0 };
        let stride = 6000_usize.div_ceil(rows).max(4);
        let time = refine(&row_times(rows, run.now, jitter, random), stride);
        let (mut load, cycle) = run.follow(&time);
        let at_rows = load.iter().step_by(stride);
        let largest = at_rows.fold(0.0_f64, |m, x| m.max(x.abs()));
        load.iter_mut().for_each(|x| *x /= largest);
        let cycles = cycle[cycle.len() - 1] + 1;
        Self {
            name,
            load,
            cycle: cycle.into_iter().step_by(stride).collect(),
            stride,
            period: (run.now - rest.unwrap_or(0.0)) / cycles as f64,
            rest,
            time,
        }
    }

    pub fn rows(&self) -> usize {
        self.cycle.len()
    }

    pub fn duration(&self) -> f64 {
        self.time[self.time.len() - 1]
    }

    /// The rows of a quantity known on the fine grid.
    pub fn sampled(&self, fine: &[f64]) -> Vec<f64> {
        fine.iter().step_by(self.stride).copied().collect()
    }

    /// The rows of a quantity read `delay` seconds late (early if negative), interpolated; before
    /// the first and after the last instant the quantity stands still.
    pub fn sampled_late(&self, fine: &[f64], delay: f64) -> Vec<f64> {
        let at = |t: f64| {
            let right = self.time.partition_point(|&x| x < t);
            if right == 0 || right == self.time.len() {
                return fine[right.min(fine.len() - 1)];
            }
            let (t0, t1) = (self.time[right - 1], self.time[right]);
            let s = (t - t0) / (t1 - t0);
            fine[right - 1] * (1.0 - s) + fine[right] * s
        };
        let rows = self.time.iter().step_by(self.stride);
        rows.map(|t| at(t - delay)).collect()
    }
}
