//! Linear axes as laboratories measure them: a screw that turns, warms, wears and is held by friction, read
//! against a scale.

use super::algebra::length_beyond;
use super::chosen::chosen;
use super::{Case, Truth, chance, pick, twin};
use ident::ground::random::Random;
use std::f64::consts::TAU;

/// One reading before it is written: everything but the error.
#[derive(Debug, Clone, Copy)]
struct Reading {
    run: usize,
    forward: bool,
    target: f64,
    time: f64,
}

/// How the laboratory works.
#[derive(Debug, Clone)]
struct Habit {
    readings: Vec<Reading>,
    pitch: f64,
    runs: usize,
    low: f64,
    high: f64,
    both_ways: bool,
    /// Scatter of a reading, µm.
    noise: f64,
    tail: bool,
    run_scatter: f64,
    rounding: f64,
    zero: f64,
    timed: bool,
    told_pitch: bool,
    told_noise: Option<f64>,
    warmth: bool,
    by_target: bool,
    german: bool,
    spacing: String,
}

fn targets(random: &mut Random, pitch: f64) -> (Vec<f64>, String) {
    let count = 8 + random.below(58);
    let low = (random.uniform(-300.0, 100.0)).round();
    match random.below(6) {
        0 => (
            (0..count).map(|i| low + pitch * i as f64).collect(),
            "whole pitches".into(),
        ),
        1 => {
            let step = *pick(random, &[10.0, 20.0, 25.0, 7.5]);
            (
                (0..count).map(|i| low + step * i as f64).collect(),
                format!("every {step} mm"),
            )
        }
        2 => {
            let step = pitch * random.uniform(1.12, 2.9);
            (
                (0..count).map(|i| low + step * i as f64).collect(),
                "even, off the pitch".into(),
            )
        }
        _ => {
            // ISO 230-2: even intervals and a random part of a pitch.
            let step = pitch * random.uniform(1.0, 4.0);
            let mut at = Vec::new();
            for i in 0..count {
                let x = low + step * i as f64 + pitch * random.uniform(-0.3, 0.3);
                at.push((x * 1e3).round() / 1e3);
            }
            (at, "even and a random part".into())
        }
    }
}

impl Habit {
    fn draw(random: &mut Random) -> Self {
        let pitch = *pick(random, &[4.0, 5.0, 5.08, 6.35, 10.0, 16.0, 20.0]);
        let (at, spacing) = targets(random, pitch);
        let runs = *pick(random, &[3, 4, 5, 5, 5, 6, 7, 7, 10]);
        let both_ways = chance(random, 0.9);
        let dwell = random.uniform(3.0, 12.0);
        let pause = random.uniform(10.0, 400.0);
        let mut time = random.uniform(0.0, 5.0);
        let mut readings = Vec::new();
        for run in 1..=runs {
            for forward in if both_ways {
                &[true, false][..]
            } else {
                &[true][..]
            } {
                for i in 0..at.len() {
                    let i = if *forward { i } else { at.len() - 1 - i };
                    readings.push(Reading {
                        run,
                        forward: *forward,
                        target: at[i],
                        time,
                    });
                    time += dwell * random.uniform(0.95, 1.1);
                }
            }
            time += pause;
        }
        let noise = random.log_uniform(0.15, 4.0);
        let timed = chance(random, 0.5);
        Self {
            pitch,
            runs,
            low: at[0],
            high: at[at.len() - 1],
            both_ways,
            noise,
            tail: chance(random, 0.2),
            run_scatter: if chance(random, 0.2) { 0.25 } else { 0.0 },
            rounding: *pick(random, &[0.001, 0.1, 0.5 * noise, noise]),
            zero: if chance(random, 0.15) {
                40.0 * noise * random.normal()
            } else {
                0.5 * noise * random.normal()
            },
            timed,
            told_pitch: chance(random, 0.8),
            told_noise: chance(random, 0.5).then(|| noise * random.uniform(0.3, 1.0)),
            warmth: timed && chance(random, 0.4),
            by_target: !timed && chance(random, 0.15),
            german: chance(random, 0.2),
            readings,
            spacing,
        }
    }

    fn of(&self, error: impl Fn(&Reading) -> f64) -> Vec<f64> {
        self.readings.iter().map(error).collect()
    }

    /// Position from 0 to 1 along the travel.
    fn along(&self, r: &Reading) -> f64 {
        (r.target - self.low) / (self.high - self.low)
    }

    fn last(&self) -> f64 {
        self.readings[self.readings.len() - 1].time
    }

    fn constant(&self) -> Vec<f64> {
        self.of(|_| 1.0)
    }

    /// Sweeps that lie where they like within their scatter: columns with what is known beforehand at their ends.
    fn sweeps(&self, spread: f64) -> Vec<Vec<f64>> {
        let sweeps: Vec<(usize, bool)> = (1..=self.runs)
            .flat_map(|run| [(run, true), (run, false)])
            .collect();
        let one = |i: usize| {
            let mut column = self.of(|r| f64::from(u8::from((r.run, r.forward) == sweeps[i])));
            column.extend((0..sweeps.len()).map(|k| {
                if k == i {
                    spread / (self.run_scatter * self.noise)
                } else {
                    0.0
                }
            }));
            column
        };
        if self.run_scatter > 0.0 {
            (0..sweeps.len()).map(one).collect()
        } else {
            Vec::new()
        }
    }

    /// A column with nothing known beforehand.
    fn bare(&self, column: &[f64]) -> Vec<f64> {
        let mut all = column.to_vec();
        all.resize(
            column.len()
                + if self.run_scatter > 0.0 {
                    2 * self.runs
                } else {
                    0
                },
            0.0,
        );
        all
    }

    /// What each known cause is nearest to, as columns.
    fn rivals(&self) -> Vec<(&'static str, Vec<Vec<f64>>)> {
        let slope = self.of(|r| self.along(r));
        let turn = |r: &Reading| TAU * r.target / self.pitch;
        let mut all = vec![
            ("pitch_scale", vec![slope]),
            (
                "backlash",
                vec![self.of(|r| f64::from(u8::from(r.forward)))],
            ),
            (
                "cyclic_error",
                vec![self.of(|r| turn(r).sin()), self.of(|r| turn(r).cos())],
            ),
        ];
        for run in 1..=self.runs {
            all.push((
                "outlier_run",
                vec![self.of(|r| f64::from(u8::from(r.run == run)))],
            ));
        }
        for share in [0.2, 0.6, 3.0] {
            let rise = |r: &Reading| 1.0 - (-r.time / (share * self.last())).exp();
            let grown = self.of(|r| rise(r) * self.along(r));
            all.push(("thermal_growth", vec![grown, self.of(rise)]));
        }
        all
    }
}

/// The error in µm of unit size over the readings, and the law's name.
fn law(effect: &str, habit: &Habit, random: &mut Random) -> (Vec<f64>, String) {
    match effect {
        "pitch_scale" => pitch_scale(habit, random),
        "backlash" => backlash(habit, random),
        "cyclic_error" => cyclic(habit, random),
        "wear_zone" => wear(habit, random),
        "thermal_growth" => thermal(habit, random),
        "outlier_run" => outlier(habit, random),
        other => outside(other, habit, random),
    }
}

fn pitch_scale(habit: &Habit, random: &mut Random) -> (Vec<f64>, String) {
    // The lead is wrong; ground threads carry a bow of a percent or so of the lead's error.
    let (home, bow) = (random.uniform(-0.2, 1.2), random.uniform(-0.015, 0.015));
    let error = habit.of(|r| {
        let u = habit.along(r);
        u - home + bow * (3.0 * u).sin()
    });
    (error, "lead".into())
}

fn backlash(habit: &Habit, random: &mut Random) -> (Vec<f64>, String) {
    // Play of the nut, and the wind-up of the screw against friction, which grows from its driven end.
    let (windup, split) = (random.uniform(0.0, 0.06), *pick(random, &[0.0, 0.5, 1.0]));
    let error = habit.of(|r| {
        let lost = 1.0 + windup * (habit.along(r) - 0.5);
        if r.forward {
            -split * lost
        } else {
            (1.0 - split) * lost
        }
    });
    (error, "play and wind-up".into())
}

fn cyclic(habit: &Habit, random: &mut Random) -> (Vec<f64>, String) {
    // A wobbling bearing: offset e of the axis gives a sine and, by the angle, a little of the second order.
    let (phase, second) = (random.uniform(0.0, TAU), random.uniform(0.0, 0.08));
    let error = habit.of(|r| {
        let turn = TAU * r.target / habit.pitch + phase;
        turn.sin() + second * (2.0 * turn + 0.7).sin()
    });
    (error, "wobble".into())
}

fn wear(habit: &Habit, random: &mut Random) -> (Vec<f64>, String) {
    let (middle, half) = (random.uniform(0.2, 0.8), random.uniform(0.07, 0.2));
    let shape = random.below(3);
    let depth = |u: f64| {
        let d = ((u - middle) / half).abs();
        match shape {
            0 => (-2.0 * d * d).exp(),
            1 if d < 1.0 => 0.5 + 0.5 * (d * TAU / 2.0).cos(),
            2 => ((1.25 - d) / 0.5).clamp(0.0, 1.0),
            _ => 0.0,
        }
    };
    // Both flanks give way alike (the lead itself), or the one that carries when going back, or on.
    let flank = random.below(3);
    let name = ["bell", "cosine", "trapezium"][shape];
    let side = ["both ways", "forward", "backward"][flank];
    let error = habit.of(|r| {
        let touched = flank == 0 || !habit.both_ways || (flank == 1) == r.forward;
        if touched { depth(habit.along(r)) } else { 0.0 }
    });
    (error, format!("{name} {side}"))
}

fn thermal(habit: &Habit, random: &mut Random) -> (Vec<f64>, String) {
    // The screw warms by its own friction: two bodies (nut side and screw), or diffusion (root of time).
    let (fixed, form) = (*pick(random, &[0.0, -0.15, 1.0, 1.1, 0.0]), random.below(3));
    let fast = random.uniform(0.08, 0.4) * habit.last();
    let warm = |t: f64| match form {
        0 => 0.7 * (1.0 - (-t / fast).exp()) + 0.3 * (1.0 - (-t / (4.0 * fast)).exp()),
        1 => (t / habit.last()).sqrt(),
        _ => 1.0 - (1.0 + t / fast).recip(),
    };
    let error = habit.of(|r| warm(r.time) * (habit.along(r) - fixed));
    (error, ["two bodies", "diffusion", "power"][form].into())
}

fn outlier(habit: &Habit, random: &mut Random) -> (Vec<f64>, String) {
    let run = 1 + random.below(habit.runs);
    let from = if chance(random, 0.6) {
        0.0
    } else {
        random.uniform(0.1, 0.5)
    };
    let own: Vec<f64> = habit
        .readings
        .iter()
        .filter(|r| r.run == run)
        .map(|r| r.time)
        .collect();
    let start = own[(from * own.len() as f64) as usize];
    let error = habit.of(|r| f64::from(u8::from(r.run == run && r.time >= start)));
    let name = if from == 0.0 {
        "whole run shifted"
    } else {
        "zero slipped within the run"
    };
    (error, name.into())
}

fn outside(name: &str, habit: &Habit, random: &mut Random) -> (Vec<f64>, String) {
    let phase = random.uniform(0.0, TAU);
    let error = match name {
        // A guide that pitches once over the travel and a half.
        "Abbe wave" => habit.of(|r| (1.4 * TAU * habit.along(r) + phase).sin()),
        // A coupling or a belt whose turn is no whole number of the screw's.
        "foreign period" => {
            let period = habit.pitch * random.uniform(3.3, 3.7);
            habit.of(|r| (TAU * r.target / period + phase).sin())
        }
        // Guide and screw askew: friction winds the one way up along the travel, the other way down.
        "ways cross" => habit.of(|r| (habit.along(r) - 0.5) * if r.forward { 1.0 } else { -1.0 }),
        _ => unreachable!("{name}"),
    };
    (error, name.into())
}

/// The causes of the contract.
const EFFECTS: [&str; 6] = [
    "pitch_scale",
    "backlash",
    "cyclic_error",
    "wear_zone",
    "thermal_growth",
    "outlier_run",
];
const OUTSIDE: [&str; 3] = ["Abbe wave", "foreign period", "ways cross"];

/// Whether this laboratory could show it at all.
fn fits(effect: &str, habit: &Habit) -> bool {
    match effect {
        "backlash" => habit.both_ways,
        "cyclic_error" => habit.told_pitch,
        "ways cross" => habit.both_ways,
        "foreign period" => habit.told_pitch && habit.readings.len() / habit.runs >= 24,
        _ => true,
    }
}

/// The errors in µm of every hidden cause and its truth.
fn hide(habit: &Habit, random: &mut Random) -> (Vec<Vec<f64>>, Vec<Truth>) {
    let names = chosen(random, [4, 12, 17], [&EFFECTS, &OUTSIDE], |name| {
        fits(name, habit)
    });
    let spread = (habit.noise.powi(2) + habit.rounding.powi(2) / 12.0).sqrt();
    let mut errors = Vec::new();
    let mut laws = Vec::new();
    for name in &names {
        let (unit, law) = law(name, habit, random);
        let mean = unit.iter().sum::<f64>() / unit.len() as f64;
        let all = unit.iter().map(|u| u.abs()).fold(1e-12, f64::max);
        let own = unit.iter().map(|u| (u - mean).abs()).fold(0.0, f64::max);
        // What is the same at every reading is no error that anyone sees: it keeps its size.
        let peak = if own > 1e-6 * all { own } else { all };
        let strength = random.log_uniform(1.5, 30.0);
        let sign = if chance(random, 0.5) { 1.0 } else { -1.0 };
        errors.push(
            unit.iter()
                .map(|u| sign * strength * spread * u / peak)
                .collect::<Vec<f64>>(),
        );
        laws.push((law, strength));
    }
    let truth = |i: usize| {
        let inside = EFFECTS.contains(&names[i]);
        let mut known = vec![habit.bare(&habit.constant())];
        known.extend(
            (0..names.len())
                .filter(|j| *j != i)
                .map(|j| habit.bare(&errors[j])),
        );
        known.extend(habit.sweeps(spread));
        let own = habit.bare(&errors[i]);
        let sight = length_beyond(&own, &known) / spread;
        let rival = |columns: &Vec<Vec<f64>>| {
            let columns = columns.iter().map(|c| habit.bare(c));
            let all: Vec<Vec<f64>> = known.iter().cloned().chain(columns).collect();
            length_beyond(&own, &all) / spread
        };
        let others = habit.rivals();
        let others: Vec<_> = others
            .iter()
            .filter(|(name, _)| !names.contains(name))
            .collect();
        let mut twins: Vec<(&'static str, Option<String>)> = others
            .iter()
            .filter(|(_, c)| inside && twin(rival(c), sight))
            .map(|o| (o.0, None))
            .collect();
        twins.dedup();
        Truth {
            effect: if inside { names[i] } else { "outside" },
            site: None,
            sight,
            apart: others.iter().map(|(_, c)| rival(c)).fold(sight, f64::min),
            twins,
            strength: laws[i].1,
            law: laws[i].0.clone(),
        }
    };
    let truths = (0..names.len()).map(truth).collect();
    (errors, truths)
}

/// A case.
pub fn draw(seed: u64) -> Case {
    let mut random = Random::new(seed ^ 0x5c4e_0000);
    let habit = Habit::draw(&mut random);
    let (errors, truths) = hide(&habit, &mut random);
    let grown = truths.iter().position(|t| t.effect == "thermal_growth");
    let grown = grown.map(|at| &errors[at]);
    let files = vec![(
        "axis.csv".to_string(),
        text(&habit, &errors, grown, &mut random),
    )];
    let said = format!(
        "{} targets {} of pitch {}, {} runs{}, noise {:.2} um{}{} rounded {:.2}, zero {:.1}{}{}{}",
        habit
            .readings
            .iter()
            .filter(|r| r.run == 1 && r.forward)
            .count(),
        habit.spacing,
        if habit.told_pitch {
            habit.pitch
        } else {
            f64::NAN
        },
        habit.runs,
        if habit.both_ways { "" } else { " one way" },
        habit.noise,
        if habit.tail { " with tails" } else { "" },
        if habit.run_scatter > 0.0 {
            " and per run"
        } else {
            ""
        },
        habit.rounding,
        habit.zero,
        if habit.timed { ", timed" } else { "" },
        if habit.warmth { ", temperature" } else { "" },
        if habit.by_target {
            ", sorted by target"
        } else {
            ""
        },
    );
    Case {
        seed,
        truths,
        habit: said,
        files,
    }
}

/// A clean file of a given laboratory, with the true lead (µm per m), play (µm) and scatter for the intervals.
pub fn known(seed: u64, lead: f64, play: f64) -> String {
    let mut random = Random::new(seed ^ 0x5c4e_1111);
    let mut habit = Habit::draw(&mut random);
    (habit.run_scatter, habit.tail, habit.zero) = (0.0, false, 0.0);
    while !habit.both_ways {
        habit = Habit::draw(&mut random);
        (habit.run_scatter, habit.tail, habit.zero) = (0.0, false, 0.0);
    }
    let error = habit.of(|r| 1e-3 * lead * r.target + if r.forward { 0.0 } else { play });
    text(&habit, &[error], None, &mut random)
}

fn scatter(habit: &Habit, random: &mut Random) -> f64 {
    let wide = random.normal();
    match habit.tail {
        false => wide,
        true => {
            // Student with six degrees of freedom, of variance one.
            let chi: f64 = (0..6).map(|_| random.normal().powi(2)).sum();
            wide / (chi / 6.0).sqrt() / 1.5_f64.sqrt()
        }
    }
}

/// How much warmer than at first the screw is, K, at each reading: what its growth in µm says of steel.
fn warmer(habit: &Habit, grown: Option<&Vec<f64>>) -> Vec<f64> {
    let Some(grown) = grown else {
        return habit.of(|_| 0.0);
    };
    // At any time the error is a slope over the travel: take it from the two readings farthest apart in a sweep.
    let per_kelvin = 11.5e-3 * (habit.high - habit.low);
    let half = habit.readings.len() / habit.runs / if habit.both_ways { 2 } else { 1 };
    let mut all = Vec::new();
    for start in (0..habit.readings.len()).step_by(half) {
        let (a, b) = (start, start + half - 1);
        let u = habit.along(&habit.readings[b]) - habit.along(&habit.readings[a]);
        let rise = (grown[b] - grown[a]) / u / per_kelvin;
        all.extend(std::iter::repeat_n(rise.abs(), half));
    }
    all
}

fn text(
    habit: &Habit,
    errors: &[Vec<f64>],
    grown: Option<&Vec<f64>>,
    random: &mut Random,
) -> String {
    let warmer = warmer(habit, grown);
    let mut lines = Vec::new();
    let (mut own, mut before) = (0.0, (0, false));
    for (i, r) in habit.readings.iter().enumerate() {
        if (r.run, r.forward) != before {
            own = habit.run_scatter * habit.noise * random.normal();
            before = (r.run, r.forward);
        }
        let hidden: f64 = errors.iter().map(|e| e[i]).sum();
        let deviation = habit.zero + own + hidden + habit.noise * scatter(habit, random);
        let um = 1e3 * r.target + deviation;
        let actual = 1e-3 * (um / habit.rounding).round() * habit.rounding;
        let word = if r.forward { "forward" } else { "backward" };
        let mut cells = vec![
            r.run.to_string(),
            word.to_string(),
            format!("{:.4}", r.target),
            format!("{actual:.7}"),
        ];
        if habit.timed {
            cells.push(format!("{:.2}", r.time));
        }
        if habit.warmth {
            cells.push(format!("{:.2}", 21.0 + warmer[i] + 0.05 * random.normal()));
        }
        lines.push((r.target, cells));
    }
    if habit.by_target {
        lines.sort_by(|a, b| a.0.total_cmp(&b.0));
    }
    let join = |cells: &Vec<String>| match habit.german {
        true => cells.join(";").replace('.', ","),
        false => cells.join(","),
    };
    let rows: Vec<String> = lines.iter().map(|(_, cells)| join(cells)).collect();
    format!("{}{}\n", head(habit), rows.join("\n"))
}

fn head(habit: &Habit) -> String {
    let mut head = String::from("# kind = \"screw\"\n# # axis X, read with the long scale\n");
    if habit.told_pitch {
        head += &format!("# pitch_mm = {}\n", habit.pitch);
    }
    if let Some(noise) = habit.told_noise {
        head += &format!("# scale_noise_um = {noise:.3}\n");
    }
    head += "# notes = { operator = \"second shift\" }\n";
    let mut titles = vec!["run", "direction", "target_mm", "actual_mm"];
    if habit.timed {
        titles.push("time_s");
    }
    if habit.warmth {
        titles.push("temperature_degC");
    }
    head + &titles.join(if habit.german { ";" } else { "," }) + "\n"
}
