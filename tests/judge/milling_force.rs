//! Dynamometers while straight cuts are milled. Teeth run on their true trochoids and take what every earlier
//! tooth has left; the dynamometer is a mass on a spring, integrated through time.

use super::algebra::length_beyond;
use super::chosen::{USUAL, chosen};
use super::{Case, Truth, chance, pick, twin};
use ident::ground::random::Random;
use std::f64::consts::{PI, TAU};

/// Forces of the three channels.
type Force = [f64; 3];

/// A straight cut. Lengths in m.
#[derive(Debug, Clone)]
struct Cut {
    rpm: f64,
    feed_mm_min: f64,
    depth: f64,
    width: f64,
    side: &'static str,
    /// Turn of tooth 1 at the first sample.
    start: f64,
}

impl Cut {
    fn feed(&self) -> f64 {
        self.feed_mm_min / 60e3
    }

    fn speed(&self) -> f64 {
        self.rpm * TAU / 60.0
    }
}

/// A tremor of the tool: which cut, amplitude m, frequency Hz, direction.
#[derive(Debug, Clone, Copy)]
struct Tremor {
    cut: usize,
    size: f64,
    frequency: f64,
    way: f64,
}

/// Tool, material, machine and sensor as they are.
#[derive(Debug, Clone)]
struct World {
    radius: f64,
    teeth: usize,
    helix: f64,
    /// N/m² and N/m: Ktc, Krc, Kac, Kte, Kre, Kae.
    k: [f64; 6],
    runout: f64,
    runout_angle: f64,
    /// Tooth, how much shorter, and up to which height from the tip.
    chip: Option<(usize, f64, f64)>,
    cuts: Vec<Cut>,
    /// True over stated speed of the spindle.
    pace: f64,
    /// Turn of the helix within one disc, rad.
    grain: f64,
    /// Added to every width that is not the whole tool, and to every depth.
    wider: f64,
    deeper: f64,
    tremor: Option<Tremor>,
    matrix: [[f64; 3]; 3],
    offset: Force,
    /// Largest drift and its time constant as a share of the record; root of time where negative.
    drift: (Force, f64),
    /// Frequency and damping ratio of what carries the sensor.
    oscillator: Option<(f64, f64)>,
}

impl World {
    fn radius_of(&self, tooth: usize, height: f64) -> f64 {
        match self.chip {
            Some((broken, short, up)) if broken == tooth && height < up => self.radius - short,
            _ => self.radius,
        }
    }

    /// Where the edge of a tooth is, seen from where the axis of the spindle was at time 0, and its angle.
    fn edge(&self, cut: &Cut, speed: f64, tooth: usize, height: f64, t: f64) -> ([f64; 2], f64) {
        let turn = cut.start + speed * t;
        let angle =
            turn - TAU * tooth as f64 / self.teeth as f64 - height * self.helix.tan() / self.radius;
        let r = self.radius_of(tooth, height);
        let out = turn + self.runout_angle;
        let (s, c) = angle.sin_cos();
        let (so, co) = out.sin_cos();
        (
            [
                cut.feed() * t + r * s + self.runout * so,
                r * c + self.runout * co,
            ],
            angle,
        )
    }

    /// Thickness of the chip: along the radius, to the farthest that an earlier tooth has reached.
    fn thickness(&self, cut: &Cut, speed: f64, tooth: usize, height: f64, t: f64) -> f64 {
        let (own, angle) = self.edge(cut, speed, tooth, height, t);
        let (s, c) = angle.sin_cos();
        let pass = TAU / speed / self.teeth as f64;
        let mut thinnest = f64::MAX;
        for earlier in 1..=self.teeth {
            let other = (tooth + self.teeth - earlier) % self.teeth;
            // The moment at which that tooth crossed the radius through this edge.
            let mut at = t - earlier as f64 * pass;
            let mut here = [0.0; 2];
            for _ in 0..3 {
                here = self.edge(cut, speed, other, height, at).0;
                let aside = (here[0] - own[0]) * c - (here[1] - own[1]) * s;
                at -= aside / (self.radius * speed);
            }
            thinnest = thinnest.min((own[0] - here[0]) * s + (own[1] - here[1]) * c);
        }
        thinnest
    }

    /// Force on the tool at one time, shared over discs.
    fn force(&self, index: usize, t: f64) -> Force {
        let cut = &self.cuts[index];
        let speed = cut.speed() * self.pace;
        let depth = cut.depth + self.deeper;
        let lag = depth * self.helix.tan() / self.radius;
        let discs = ((lag / self.grain).ceil() as usize).clamp(4, 400);
        let dz = depth / discs as f64;
        let width = if cut.side == "slot" {
            2.0 * self.radius
        } else {
            cut.width + self.wider
        };
        let mut sum = [0.0; 3];
        for disc in 0..discs {
            let height = (disc as f64 + 0.5) * dz;
            for tooth in 0..self.teeth {
                let (_, angle) = self.edge(cut, speed, tooth, height, t);
                let (s, c) = angle.sin_cos();
                if s <= -0.2 {
                    continue;
                }
                // An edge enters and leaves steadily: a disc on the border counts by its share.
                let [low, high] = [-0.5, 0.5].map(|end| {
                    let y = self.edge(cut, speed, tooth, height + end * dz, t).0[1];
                    match cut.side {
                        "up" => y - (self.radius - width),
                        "down" => width - self.radius - y,
                        _ => 1.0,
                    }
                });
                let share = match (low > 0.0, high > 0.0) {
                    (true, true) => 1.0,
                    (false, false) => continue,
                    _ => low.max(high) / (low - high).abs(),
                };
                let mut h = self.thickness(cut, speed, tooth, height, t);
                if let Some(tremor) = self.tremor.filter(|tremor| tremor.cut == index) {
                    let pass = TAU / speed / self.teeth as f64;
                    let push = |t: f64| tremor.size * (TAU * tremor.frequency * t).sin();
                    let along = tremor.way.cos() * s + tremor.way.sin() * c;
                    h += (push(t) - push(t - pass)) * along;
                }
                if h <= 0.0 {
                    continue;
                }
                let [ft, fr, fa]: [f64; 3] =
                    std::array::from_fn(|i| (self.k[i] * h + self.k[i + 3]) * dz * share);
                sum[0] += -ft * c - fr * s;
                sum[1] += ft * s - fr * c;
                sum[2] += fa;
            }
        }
        sum
    }

    /// Forces at even angles over one revolution, `points` of them.
    fn revolution(&self, index: usize, points: usize) -> Vec<Force> {
        let turn = TAU / (self.cuts[index].speed() * self.pace);
        (0..points)
            .map(|i| self.force(index, turn * i as f64 / points as f64))
            .collect()
    }
}

/// How the record is taken.
#[derive(Debug, Clone)]
struct Habit {
    told: World,
    rel_std: f64,
    told_nominal: bool,
    told_runout: bool,
    told_noise: bool,
    on_tool: bool,
    noise: f64,
    rate: f64,
    /// Samples of each cut.
    samples: Vec<usize>,
    pause: f64,
    rounding: f64,
}

const MATERIALS: [[f64; 6]; 5] = [
    [1319.41, 788.83, 48.75, 19.65, 26.77, 2.05],
    [951.365, 262.597, 323.33, 11.115, 11.314, 1.105],
    [767.01, 168.8, 222.0, 27.7, 26.6, 0.7],
    [631.0, 99.0, 273.0, 13.0, 10.0, 2.8],
    [958.86, 250.86, 146.36, 15.758, 19.434, 18.2075],
];

fn identity() -> [[f64; 3]; 3] {
    std::array::from_fn(|i| std::array::from_fn(|j| f64::from(u8::from(i == j))))
}

fn cuts(random: &mut Random, diameter: f64, teeth: usize) -> Vec<Cut> {
    let count = 2 + random.below(5);
    let rpm = (random.log_uniform(3000.0, 18000.0) / 100.0).round() * 100.0;
    let depth = (random.uniform(0.5, 0.2 * diameter) * 10.0).round() / 10.0;
    let same = chance(random, 0.4);
    let sides = [
        *pick(random, &["slot", "down", "up"]),
        *pick(random, &["slot", "down", "up"]),
    ];
    let mut all = Vec::new();
    for i in 0..count {
        let per_tooth = random.uniform(0.03, 0.18);
        let rpm = if same {
            rpm
        } else {
            (rpm * random.uniform(0.7, 1.4) / 100.0).round() * 100.0
        };
        let side = sides[i % 2];
        let width = if side == "slot" {
            diameter
        } else {
            (diameter * random.uniform(0.15, 0.7) * 10.0).round() / 10.0
        };
        all.push(Cut {
            rpm: rpm.min(18000.0),
            feed_mm_min: (per_tooth * teeth as f64 * rpm).round(),
            depth: 1e-3
                * if same {
                    depth
                } else {
                    (depth * random.uniform(0.5, 1.5) * 10.0).round().max(3.0) / 10.0
                },
            width: 1e-3 * width,
            side,
            start: random.uniform(0.0, TAU),
        });
    }
    all
}

impl Habit {
    fn draw(random: &mut Random) -> Self {
        let diameter = *pick(random, &[6.0, 8.0, 10.0, 12.0, 16.0, 20.0, 25.0]);
        let teeth = *pick(random, &[1, 2, 2, 2, 3, 3, 4, 4]);
        let helix: f64 = *pick(random, &[0.0, 15.0, 30.0, 30.0, 38.0, 45.0]);
        let m = *pick(random, &MATERIALS);
        let cuts = cuts(random, diameter, teeth);
        let fastest = cuts.iter().map(|c| c.rpm).fold(0.0, f64::max);
        let per_turn = *pick(random, &[60.0, 90.0, 140.0]);
        let rate = (fastest / 60.0 * per_turn / 1000.0).ceil() * 1000.0;
        let turns = 5 + random.below(8);
        let samples = cuts
            .iter()
            .map(|c| (turns as f64 * 60.0 / c.rpm * rate) as usize)
            .collect();
        let told_runout = chance(random, 0.3);
        Self {
            told: World {
                radius: 0.5e-3 * diameter,
                teeth,
                helix: helix.to_radians(),
                k: std::array::from_fn(|i| m[i] * if i < 3 { 1e6 } else { 1e3 }),
                runout: if told_runout && teeth > 1 {
                    1e-6 * random.uniform(3.0, 15.0).round()
                } else {
                    0.0
                },
                runout_angle: random.uniform(0.0, TAU),
                chip: None,
                cuts,
                pace: 1.0,
                grain: 0.03,
                wider: 0.0,
                deeper: 0.0,
                tremor: None,
                matrix: identity(),
                offset: [0.0; 3],
                drift: ([0.0; 3], 1.0),
                oscillator: chance(random, 0.5)
                    .then(|| (random.uniform(0.15, 0.4) * rate, 0.5_f64.sqrt())),
            },
            rel_std: *pick(random, &[0.02, 0.03, 0.05]),
            told_nominal: chance(random, 0.85),
            told_runout,
            told_noise: chance(random, 0.6),
            on_tool: chance(random, 0.4),
            noise: random.log_uniform(0.3, 6.0),
            rate,
            samples,
            pause: random.uniform(0.0, 0.4),
            rounding: *pick(random, &[1e-3, 0.3, 1.0]),
        }
    }

    /// A clean day: coefficients as well known as the file says.
    fn real(&self, random: &mut Random) -> World {
        let mut world = self.told.clone();
        if self.told_nominal {
            world.k = world
                .k
                .map(|k| k * (1.0 + self.rel_std * random.normal().clamp(-2.0, 2.0)));
        }
        world.pace = 1.0 + 1e-4 * random.normal();
        world
    }

    /// What the channels read without noise, all cuts one after the other; `points` per revolution.
    fn readings(&self, world: &World, points: usize) -> Vec<Force> {
        let mut all = Vec::new();
        let whole: f64 = self
            .samples
            .iter()
            .map(|n| *n as f64 / self.rate + self.pause)
            .sum();
        let mut clock = 0.0;
        for (index, count) in self.samples.iter().enumerate() {
            // Without a mass before it a jump is a jump: no table is fine enough for what is judged closely.
            let wild = world.tremor.is_some_and(|tremor| tremor.cut == index);
            let wild = wild || world.oscillator.is_none() && points > COARSE;
            let table = if wild {
                Vec::new()
            } else {
                world.revolution(index, points)
            };
            let speed = world.cuts[index].speed() * world.pace;
            let at = |t: f64| {
                if wild {
                    return world.force(index, t);
                }
                let place = (speed * t / TAU).rem_euclid(1.0) * table.len() as f64;
                let (i, u) = (place.floor() as usize % table.len(), place.fract());
                let next = (i + 1) % table.len();
                std::array::from_fn(|k| table[i][k] * (1.0 - u) + table[next][k] * u)
            };
            let seen: Vec<Force> = match world.oscillator {
                None => (0..*count).map(|i| at(i as f64 / self.rate)).collect(),
                Some((hz, damping)) => carried(&at, hz, damping, self.rate, *count),
            };
            for (i, f) in seen.iter().enumerate() {
                let t = clock + i as f64 / self.rate;
                let (most, share) = world.drift;
                let risen = if share > 0.0 {
                    1.0 - (-t / (share * whole)).exp()
                } else {
                    (t / whole).sqrt()
                };
                let sign = if self.on_tool { 1.0 } else { -1.0 };
                all.push(std::array::from_fn(|a| {
                    let mixed: f64 = (0..3).map(|b| world.matrix[a][b] * f[b]).sum();
                    sign * mixed + world.offset[a] + most[a] * risen
                }));
            }
            clock += *count as f64 / self.rate + self.pause;
        }
        all
    }

    fn flat(&self, a: &[Force], b: &[Force], tail: &[f64]) -> Vec<f64> {
        let pair = a.iter().zip(b);
        let mut all: Vec<f64> = pair
            .flat_map(|(a, b)| (0..3).map(move |i| (b[i] - a[i]) / self.noise))
            .collect();
        all.extend(tail);
        all
    }

    /// What is free on a clean day, one column each: coefficients, speed, width, starts of the cuts, band.
    fn free(&self, base: &World) -> Vec<Vec<f64>> {
        let (points, cuts) = (COARSE, base.cuts.len());
        let from = self.readings(base, points);
        let count = 9 + cuts;
        let mut all = Vec::new();
        for i in 0..count {
            let mut world = base.clone();
            let mut prior = 0.0;
            match i {
                0..6 => {
                    world.k[i] *= 1.01;
                    prior = if self.told_nominal {
                        0.01 / self.rel_std
                    } else {
                        0.0
                    };
                }
                6 => {
                    world.pace += 1e-4;
                    prior = 0.1;
                }
                7 => {
                    world.wider += 1e-5;
                    prior = 0.5;
                }
                8 => {
                    let Some((hz, damping)) = world.oscillator else {
                        continue;
                    };
                    world.oscillator = Some((1.02 * hz, damping));
                    prior = 0.1;
                }
                _ => world.cuts[i - 9].start += 2e-3,
            }
            let mut tail = vec![0.0; count];
            tail[i] = prior;
            all.push(self.flat(&from, &self.readings(&world, points), &tail));
        }
        all
    }

    /// Every cause that is one step of the world, as columns beside those of `free`.
    fn rivals(&self, base: &World) -> Vec<(&'static str, Vec<Vec<f64>>)> {
        let from = self.readings(base, COARSE);
        let tail = vec![0.0; 9 + base.cuts.len()];
        let of = |change: &dyn Fn(&mut World)| {
            let mut world = base.clone();
            change(&mut world);
            self.flat(&from, &self.readings(&world, COARSE), &tail)
        };
        let coefficient = |i: usize| of(&|w| w.k[i] *= 1.01);
        let mut all: Vec<(&'static str, Vec<Vec<f64>>)> = vec![
            ("cutting_coefficients", (0..3).map(coefficient).collect()),
            ("edge_coefficients", (3..6).map(coefficient).collect()),
            ("depth_of_cut", vec![of(&|w| w.deeper += 1e-5)]),
            ("width_of_cut", vec![of(&|w| w.wider += 2e-5)]),
            ("spindle_speed", vec![of(&|w| w.pace += 2e-4)]),
        ];
        let turn = |angle: f64| {
            of(&|w| (w.runout, w.runout_angle) = (w.runout + 5e-6, w.runout_angle + angle))
        };
        all.push(("runout", vec![turn(0.0), turn(PI / 2.0)]));
        for i in 0..3 {
            all.push(("force_gain", vec![of(&|w| w.matrix[i][i] += 1e-2)]));
            all.push(("sensor_offset", vec![of(&|w| w.offset[i] += 1.0)]));
        }
        for (i, j) in [(0, 1), (0, 2), (1, 0), (1, 2), (2, 0), (2, 1)] {
            all.push(("cross_talk", vec![of(&|w| w.matrix[i][j] += 1e-2)]));
        }
        for i in 0..3 {
            all.push(("thermal_drift", vec![of(&|w| w.drift.0[i] = 1.0)]));
        }
        if base.teeth > 1 {
            for tooth in 0..base.teeth {
                all.push((
                    "chipped_tooth",
                    vec![of(&|w| w.chip = Some((tooth, 1e-5, 1.0)))],
                ));
            }
        }
        all
    }
}

/// Angles per revolution of what only judges sizes, and of the data.
const COARSE: usize = 180;
const FINE: usize = 4320;

/// A mass on a spring and a damper under the force (Runge and Kutta, twelve steps a sample and no longer than a
/// fortieth of its period); settled over three cycles before the first sample.
fn carried(
    at: &dyn Fn(f64) -> Force,
    hz: f64,
    damping: f64,
    rate: f64,
    count: usize,
) -> Vec<Force> {
    let w = TAU * hz;
    let steps = (40.0 * hz / rate).ceil().max(12.0) as usize;
    let dt = 1.0 / rate / steps as f64;
    let lead = (5.0 / (damping * w) * rate).ceil() as i64;
    let (mut x, mut v) = (at(-lead as f64 / rate), [0.0; 3]);
    let mut seen = Vec::with_capacity(count);
    let mut f0 = x;
    for sample in -lead..count as i64 {
        if sample >= 0 {
            seen.push(x);
        }
        for step in 0..steps {
            let t = sample as f64 / rate + step as f64 * dt;
            let (fm, f1) = (at(t + 0.5 * dt), at(t + dt));
            for k in 0..3 {
                let pull = |f: f64, x: f64, v: f64| w * w * (f - x) - 2.0 * damping * w * v;
                let (v1, a1) = (v[k], pull(f0[k], x[k], v[k]));
                let (v2, a2) = (
                    v[k] + 0.5 * dt * a1,
                    pull(fm[k], x[k] + 0.5 * dt * v1, v[k] + 0.5 * dt * a1),
                );
                let (v3, a3) = (
                    v[k] + 0.5 * dt * a2,
                    pull(fm[k], x[k] + 0.5 * dt * v2, v[k] + 0.5 * dt * a2),
                );
                let (v4, a4) = (v[k] + dt * a3, pull(f1[k], x[k] + dt * v3, v[k] + dt * a3));
                x[k] += dt / 6.0 * (v1 + 2.0 * v2 + 2.0 * v3 + v4);
                v[k] += dt / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
            }
            f0 = f1;
        }
    }
    seen
}

/// A cause in place: its site and law.
struct Placed {
    site: Option<String>,
    law: String,
}

fn place(effect: &str, habit: &Habit, world: &mut World, random: &mut Random) -> Placed {
    let sign = if chance(random, 0.5) { 1.0 } else { -1.0 };
    let mut site = None;
    let least = 6.0
        * if habit.told_nominal {
            habit.rel_std
        } else {
            0.03
        };
    let law = match effect {
        "cutting_coefficients" => {
            let by: [f64; 3] = std::array::from_fn(|_| least * random.uniform(0.6, 1.6));
            (0..3).for_each(|i| world.k[i] *= 1.0 + sign * by[i]);
            format!(
                "by {:.2} {:.2} {:.2}",
                sign * by[0],
                sign * by[1],
                sign * by[2]
            )
        }
        "edge_coefficients" => {
            let by = (1.5 * least).max(random.uniform(0.3, 1.5));
            let own: [f64; 3] = std::array::from_fn(|_| by * random.uniform(0.7, 1.3));
            (0..3).for_each(|i| world.k[i + 3] *= 1.0 + own[i]);
            format!("worn by {by:.2}")
        }
        "runout" => {
            let e = 1e-6 * random.log_uniform(4.0, 40.0);
            (world.runout, world.runout_angle) = (world.runout + e, random.uniform(0.0, TAU));
            format!("{:.0} um", 1e6 * e)
        }
        "chipped_tooth" => {
            let short = 1e-6 * random.log_uniform(10.0, 60.0);
            let deepest = world.cuts.iter().map(|c| c.depth).fold(0.0, f64::max);
            let up = if chance(random, 0.6) {
                1.0
            } else {
                deepest * random.uniform(0.5, 0.9)
            };
            world.chip = Some((random.below(world.teeth), short, up));
            format!(
                "{:.0} um{}",
                1e6 * short,
                if up < 1.0 { " at the tip" } else { "" }
            )
        }
        "width_of_cut" => {
            world.wider = sign * 1e-3 * random.uniform(0.15, 0.6);
            format!("{:.2} mm", 1e3 * world.wider)
        }
        "depth_of_cut" => {
            let least_depth = world.cuts.iter().map(|c| c.depth).fold(1.0, f64::min);
            world.deeper = sign * least_depth * random.uniform(0.08, 0.3);
            format!("{:.2} mm", 1e3 * world.deeper)
        }
        "spindle_speed" => {
            world.pace *= 1.0 - random.log_uniform(0.005, 0.03);
            format!("{:.3}", world.pace)
        }
        "force_gain" => {
            let i = random.below(3);
            world.matrix[i][i] += sign * random.log_uniform(0.05, 0.3).max(least);
            site = Some(["sensor-x", "sensor-y", "sensor-z"][i].to_string());
            format!("{:.2}", world.matrix[i][i])
        }
        "cross_talk" => {
            let (i, j) = *pick(random, &[(0, 1), (0, 2), (1, 0), (1, 2), (2, 0), (2, 1)]);
            world.matrix[i][j] += sign * random.log_uniform(0.03, 0.25);
            format!("{i} of {j} {:.2}", world.matrix[i][j])
        }
        "sensor_offset" => {
            let i = random.below(3);
            world.offset[i] = sign * habit.noise * random.log_uniform(1.0, 15.0);
            format!("channel {i}")
        }
        "thermal_drift" => {
            let i = random.below(3);
            world.drift.0[i] = sign * habit.noise * random.log_uniform(2.0, 20.0);
            world.drift.1 = if chance(random, 0.4) {
                -1.0
            } else {
                random.uniform(0.2, 1.0)
            };
            format!(
                "channel {i} {}",
                if world.drift.1 < 0.0 {
                    "root of time"
                } else {
                    "exponential"
                }
            )
        }
        "sensor_resonance" => {
            let passing = world
                .cuts
                .iter()
                .map(|c| c.rpm / 60.0 * world.teeth as f64)
                .fold(0.0, f64::max);
            let hz = random.uniform(1.6, 6.0) * passing;
            world.oscillator = Some((hz.min(0.35 * habit.rate), random.uniform(0.02, 0.12)));
            format!(
                "{hz:.0} Hz damped {:.2}",
                world.oscillator.map_or(0.0, |o| o.1)
            )
        }
        "chatter" => {
            let cut = random.below(world.cuts.len());
            let passing = world.cuts[cut].rpm / 60.0 * world.teeth as f64;
            let frequency = passing * (random.below(3) as f64 + 1.0 + random.uniform(0.2, 0.45));
            world.tremor = Some(Tremor {
                cut,
                size: 1e-6 * random.log_uniform(2.0, 25.0),
                frequency,
                way: random.uniform(0.0, TAU),
            });
            format!("{frequency:.0} Hz in cut {}", cut + 1)
        }
        other => unreachable!("{other}"),
    };
    Placed { site, law }
}

const EFFECTS: [&str; 13] = [
    "cutting_coefficients",
    "edge_coefficients",
    "runout",
    "chipped_tooth",
    "width_of_cut",
    "depth_of_cut",
    "spindle_speed",
    "force_gain",
    "cross_talk",
    "sensor_offset",
    "thermal_drift",
    "sensor_resonance",
    "chatter",
];
const OUTSIDE: [&str; 3] = ["hard spots", "mains hum", "channel clips"];

fn fits(effect: &str, habit: &Habit) -> bool {
    let side = habit.told.cuts.iter().any(|c| c.side != "slot");
    match effect {
        "cutting_coefficients"
        | "edge_coefficients"
        | "force_gain"
        | "depth_of_cut"
        | "cross_talk" => habit.told_nominal,
        "runout" => habit.told.teeth > 1 && !habit.told_runout,
        "chipped_tooth" => habit.told.teeth > 1,
        "width_of_cut" => side,
        _ => true,
    }
}

/// What nobody in the library explains, as it changes the readings.
fn outside(name: &str, habit: &Habit, rows: &mut [Force], random: &mut Random) {
    let peak = rows.iter().flatten().fold(0.0_f64, |m, f| m.max(f.abs()));
    let size = habit.noise * random.log_uniform(4.0, 20.0);
    let (a, phase, hz) = (
        random.below(3),
        random.uniform(0.0, TAU),
        *pick(random, &[50.0, 60.0, 150.0]),
    );
    let blows: Vec<f64> = (0..4).map(|_| random.unit()).collect();
    let count = rows.len() as f64;
    let limit = peak * random.uniform(0.5, 0.75);
    for (i, row) in rows.iter_mut().enumerate() {
        let t = i as f64 / habit.rate;
        match name {
            // Inclusions: for a few revolutions everything is harder.
            "hard spots" => {
                let near = |b: &f64| (-(0.5 * ((i as f64 / count - b) / 0.02).powi(2))).exp();
                let hard: f64 = blows.iter().map(near).sum();
                *row = row.map(|f| f * (1.0 + 4.0 * size / peak * hard));
            }
            "mains hum" => row[a] += size * (TAU * hz * t + phase).sin(),
            // The amplifier saturates.
            _ => *row = row.map(|f| f.clamp(-limit, limit)),
        }
    }
}

/// A case.
pub fn draw(seed: u64) -> Case {
    let mut random = Random::new(seed ^ 0x3111_0000);
    let habit = Habit::draw(&mut random);
    let names = chosen(&mut random, USUAL, [&EFFECTS, &OUTSIDE], |name| {
        fits(name, &habit)
    });
    let real = habit.real(&mut random);
    let mut world = real.clone();
    let placed: Vec<Placed> = names
        .iter()
        .filter(|n| EFFECTS.contains(n))
        .map(|n| place(n, &habit, &mut world, &mut random))
        .collect();
    world.grain = 0.012;
    let mut rows = habit.readings(&world, FINE);
    world.grain = 0.03;
    let mut truths = Vec::new();
    for (i, name) in names.iter().enumerate() {
        match placed.get(i) {
            Some(placed) => truths.push(truth(&habit, &real, &world, &names, i, placed)),
            None => {
                let before = rows.clone();
                outside(name, &habit, &mut rows, &mut random);
                let change = habit.flat(&before, &rows, &[]);
                let size = super::algebra::dot(&change, &change).sqrt();
                truths.push(Truth {
                    effect: "outside",
                    site: None,
                    sight: size,
                    apart: size,
                    twins: Vec::new(),
                    strength: peak(&change),
                    law: name.to_string(),
                });
            }
        }
    }
    let said = format!(
        "d {:.0} z {} helix {:.0}, cuts {}, {:.0} Hz{}, noise {:.2} N{}{}{} rounded {:.2}",
        2e3 * habit.told.radius,
        habit.told.teeth,
        habit.told.helix.to_degrees(),
        habit
            .told
            .cuts
            .iter()
            .map(|c| format!(
                "{} {:.0}/min fz {:.2} a {:.1} b {:.1}",
                c.side,
                c.rpm,
                c.feed_mm_min / c.rpm / habit.told.teeth as f64,
                1e3 * c.depth,
                1e3 * c.width
            ))
            .collect::<Vec<_>>()
            .join("; "),
        habit.rate,
        habit
            .told
            .oscillator
            .map_or(String::new(), |o| format!(" band {:.0}", o.0)),
        habit.noise,
        if habit.told_nominal {
            format!(", nominal to {}", habit.rel_std)
        } else {
            String::new()
        },
        if habit.told.runout > 0.0 {
            format!(", runout {:.0} um told", 1e6 * habit.told.runout)
        } else {
            String::new()
        },
        if habit.on_tool { ", on the tool" } else { "" },
        habit.rounding,
    );
    let files = vec![("cuts.csv".to_string(), text(&habit, &rows, &mut random))];
    Case {
        seed,
        truths,
        habit: said,
        files,
    }
}

fn peak(change: &[f64]) -> f64 {
    change.iter().map(|x| x.abs()).fold(0.0, f64::max)
}

fn truth(
    habit: &Habit,
    real: &World,
    all: &World,
    names: &[&'static str],
    at: usize,
    placed: &Placed,
) -> Truth {
    let name = names[at];
    // The world with everything but this one: the difference is what it does.
    let mut without = all.clone();
    match name {
        "cutting_coefficients" => (0..3).for_each(|i| without.k[i] = real.k[i]),
        "edge_coefficients" => (3..6).for_each(|i| without.k[i] = real.k[i]),
        "runout" => (without.runout, without.runout_angle) = (real.runout, real.runout_angle),
        "chipped_tooth" => without.chip = None,
        "width_of_cut" => without.wider = 0.0,
        "depth_of_cut" => without.deeper = 0.0,
        "spindle_speed" => without.pace = real.pace,
        "force_gain" => (0..3).for_each(|i| without.matrix[i][i] = 1.0),
        "cross_talk" => (0..3).for_each(|i| {
            (0..3)
                .filter(|j| *j != i)
                .for_each(|j| without.matrix[i][j] = 0.0)
        }),
        "sensor_offset" => without.offset = [0.0; 3],
        "thermal_drift" => without.drift = real.drift,
        "sensor_resonance" => without.oscillator = real.oscillator,
        _ => without.tremor = None,
    }
    let (a, b) = (
        habit.readings(&without, COARSE),
        habit.readings(all, COARSE),
    );
    let free = habit.free(real);
    let own = habit.flat(&a, &b, &vec![0.0; 9 + real.cuts.len()]);
    let sight = length_beyond(&own, &free);
    let rival = |columns: &Vec<Vec<f64>>| {
        let with: Vec<Vec<f64>> = free.iter().chain(columns).cloned().collect();
        length_beyond(&own, &with)
    };
    let rivals = habit.rivals(real);
    let near: Vec<(&'static str, f64)> = rivals
        .iter()
        .filter(|(n, _)| !names.contains(n))
        .map(|(n, c)| (*n, rival(c)))
        .collect();
    // Two teeth: a short one and an offset of the axis are one.
    let mut twins: Vec<(&'static str, Option<String>)> = near
        .iter()
        .filter(|n| twin(n.1, sight))
        .map(|n| (n.0, None))
        .collect();
    if real.teeth == 2 || real.teeth == 3 && real.helix == 0.0 {
        match name {
            "runout" if real.teeth == 2 => twins.push(("chipped_tooth", None)),
            "chipped_tooth" => twins.push(("runout", None)),
            _ => {}
        }
    }
    twins.dedup();
    Truth {
        effect: name,
        site: placed.site.clone(),
        sight,
        apart: near.iter().map(|n| n.1).fold(sight, f64::min),
        twins,
        strength: peak(&own),
        law: placed.law.clone(),
    }
}

fn text(habit: &Habit, rows: &[Force], random: &mut Random) -> String {
    let w = &habit.told;
    let cut = |c: &Cut| {
        format!(
            "{{ spindle_rpm = {:.1}, feed_mm_min = {:.1}, depth_mm = {:.3}, width_mm = {:.3}, cut = \"{}\" }}",
            c.rpm,
            c.feed_mm_min,
            1e3 * c.depth,
            1e3 * c.width,
            c.side
        )
    };
    let cuts: Vec<String> = w.cuts.iter().map(cut).collect();
    let mut head = format!(
        "# kind = \"milling-force\"\n# diameter_mm = {:.1}\n# teeth = {}\n# cuts = [{}]\n",
        2e3 * w.radius,
        w.teeth,
        cuts.join(", ")
    );
    if w.helix > 0.0 || chance(random, 0.5) {
        head += &format!("# helix_deg = {:.1}\n", w.helix.to_degrees());
    }
    if habit.on_tool {
        head += "# force_on = \"tool\"\n";
    }
    if let Some((hz, _)) = w.oscillator {
        head += &format!("# bandwidth_Hz = {hz:.1}\n");
    }
    if habit.told_nominal {
        let k = w.k;
        head += &format!(
            "# nominal = {{ Ktc_N_mm2 = {:.4}, Krc_N_mm2 = {:.4}, Kac_N_mm2 = {:.4}, Kte_N_mm = {:.4}, Kre_N_mm = {:.4}, Kae_N_mm = {:.4}, rel_std = {} }}\n",
            1e-6 * k[0],
            1e-6 * k[1],
            1e-6 * k[2],
            1e-3 * k[3],
            1e-3 * k[4],
            1e-3 * k[5],
            habit.rel_std
        );
    }
    if habit.told_noise {
        head += &format!("# sensor_noise_N = {:.3}\n", habit.noise);
    }
    if w.runout > 0.0 {
        head += &format!("# runout_um = {:.1}\n", 1e6 * w.runout);
    }
    head += "cut,time_s,fx_N,fy_N,fz_N\n";
    let (mut clock, mut row, step) = (0.0, 0, habit.rounding * habit.noise);
    for (index, count) in habit.samples.iter().enumerate() {
        for i in 0..*count {
            let read =
                rows[row].map(|f| ((f + habit.noise * random.normal()) / step).round() * step);
            head += &format!(
                "{},{:.7},{:.4},{:.4},{:.4}\n",
                index + 1,
                clock + i as f64 / habit.rate,
                read[0],
                read[1],
                read[2]
            );
            row += 1;
        }
        clock += *count as f64 / habit.rate + habit.pause;
    }
    head
}

/// A clean file and what is true of it: names and values in N/mm², N/mm and µm.
pub fn known(seed: u64) -> (String, Vec<(&'static str, f64)>) {
    let mut random = Random::new(seed ^ 0x3111_1111);
    let mut habit = Habit::draw(&mut random);
    (habit.rounding, habit.told_nominal) = (1e-3, false);
    let mut world = habit.told.clone();
    if world.teeth > 1 {
        (world.runout, habit.told.runout) = (1e-6 * random.uniform(2.0, 20.0), 0.0);
    }
    world.grain = 0.004;
    let rows = habit.readings(&world, 8640);
    let text = text(&habit, &rows, &mut random);
    let names = ["Ktc", "Krc", "Kac", "Kte", "Kre", "Kae"];
    let said = |i: usize| world.k[i] * if i < 3 { 1e-6 } else { 1e-3 };
    let mut truth: Vec<(&'static str, f64)> = (0..6).map(|i| (names[i], said(i))).collect();
    if world.teeth > 1 {
        truth.push(("runout", 1e6 * world.runout));
    }
    (text, truth)
}
