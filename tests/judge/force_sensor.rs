//! Force-torque sensors that carry a tool through orientations: statics by quaternions, cables that sag and
//! pull, zeros that warm up.

use super::algebra::{
    Quat, V3, axis, cross, length_beyond, minus, norm, plus, scaled, times, turn, turned, unit,
};
use super::chosen::{USUAL, chosen};
use super::{Case, Truth, chance, pick, twin};
use ident::ground::random::Random;
use std::f64::consts::{PI, TAU};

/// Forces and moments of every row.
type Record = Vec<[f64; 6]>;

/// What is true of the sensor and its tool.
#[derive(Debug, Clone)]
struct World {
    weight: f64,
    centre: V3,
    offset: [f64; 6],
    /// Turn of the sensor against where its mounting says.
    mounting: Quat,
    /// Direction of weight in base axes.
    down: V3,
    /// What the amplifiers make of the six loads.
    matrix: [[f64; 6]; 6],
}

/// How the laboratory works.
#[derive(Debug, Clone)]
struct Habit {
    poses: Vec<Quat>,
    /// Rows: point and time.
    rows: Vec<(usize, f64)>,
    told: World,
    rel_std: f64,
    told_nominal: bool,
    told_std: bool,
    noise: [f64; 2],
    told_noise: bool,
    timed: bool,
    numbered: bool,
    euler: bool,
    rounding: f64,
    way: &'static str,
}

impl World {
    fn read(&self, pose: Quat) -> [f64; 6] {
        let sensor = times(pose, self.mounting);
        let back = super::algebra::inverse(sensor);
        let force = turned(back, scaled(self.down, self.weight));
        let moment = cross(self.centre, force);
        self.amplified(force, moment)
    }

    fn amplified(&self, f: V3, m: V3) -> [f64; 6] {
        let load = [f[0], f[1], f[2], m[0], m[1], m[2]];
        std::array::from_fn(|i| {
            self.offset[i] + (0..6).map(|j| self.matrix[i][j] * load[j]).sum::<f64>()
        })
    }
}

fn identity() -> [[f64; 6]; 6] {
    std::array::from_fn(|i| std::array::from_fn(|j| f64::from(u8::from(i == j))))
}

fn anywhere(random: &mut Random) -> Quat {
    let q: [f64; 4] = std::array::from_fn(|_| random.normal());
    let size = q.iter().map(|x| x * x).sum::<f64>().sqrt();
    q.map(|x| x / size)
}

/// Poses as a wrist takes them: from anywhere, on a grid of swings and turns, or tilted moderately from hanging.
fn poses(random: &mut Random) -> (Vec<Quat>, &'static str) {
    let hanging = turn(axis(0), PI);
    match random.below(4) {
        0 => (
            (0..12 + random.below(40))
                .map(|_| anywhere(random))
                .collect(),
            "anywhere",
        ),
        1 => {
            let (swings, turns) = (3 + random.below(3), 3 + random.below(5));
            let mut all = Vec::new();
            for s in 0..swings {
                for t in 0..turns {
                    let swing = turn(axis(1), -1.9 + 3.8 * s as f64 / (swings - 1) as f64);
                    all.push(times(
                        times(hanging, swing),
                        turn(axis(2), TAU * t as f64 / turns as f64),
                    ));
                }
            }
            (all, "grid of A5 and A6")
        }
        2 => {
            let one = |random: &mut Random| {
                let about = unit([random.normal(), random.normal(), 0.0]);
                let tilt = turn(about, random.uniform(0.0, 1.3));
                times(times(tilt, hanging), turn(axis(2), random.uniform(-PI, PI)))
            };
            (
                (0..10 + random.below(30)).map(|_| one(random)).collect(),
                "within 75 degrees of hanging",
            )
        }
        _ => {
            // The six faces of a die, each with a few turns about the vertical.
            let faces = [
                turn(axis(0), 0.0),
                turn(axis(0), PI),
                turn(axis(0), PI / 2.0),
                turn(axis(0), -PI / 2.0),
                turn(axis(1), PI / 2.0),
                turn(axis(1), -PI / 2.0),
            ];
            let mut all = Vec::new();
            for face in faces {
                for _ in 0..2 + random.below(3) {
                    all.push(times(turn(axis(2), random.uniform(-PI, PI)), face));
                }
            }
            (all, "six faces, turned about the vertical")
        }
    }
}

impl Habit {
    fn draw(random: &mut Random) -> Self {
        let (poses, way) = poses(random);
        let weight = random.log_uniform(30.0, 600.0);
        let centre = [
            0.02 * random.normal(),
            0.02 * random.normal(),
            random.uniform(0.05, 0.25),
        ];
        let force = weight * random.log_uniform(2e-4, 3e-3);
        let noise = [force, force * random.uniform(0.02, 0.1)];
        let readings = 1 + random.below(4);
        let mut rows = Vec::new();
        let mut time = 0.0;
        for point in 0..poses.len() {
            time += random.uniform(6.0, 20.0);
            for _ in 0..readings {
                rows.push((point, time));
                time += 0.5;
            }
        }
        let timed = chance(random, 0.6);
        Self {
            poses,
            rows,
            told: World {
                weight,
                centre,
                offset: [0.0; 6],
                mounting: turn(axis(0), 0.0),
                down: [0.0, 0.0, -1.0],
                matrix: identity(),
            },
            rel_std: *pick(random, &[0.005, 0.01, 0.02]),
            told_nominal: chance(random, 0.85),
            told_std: chance(random, 0.8),
            noise,
            told_noise: chance(random, 0.6),
            timed,
            numbered: readings > 1 || chance(random, 0.7),
            euler: chance(random, 0.4),
            rounding: *pick(random, &[1e-6, 0.3, 1.0]),
            way,
        }
    }

    /// The real tool of a clean day: near what the file says.
    fn real(&self, random: &mut Random) -> World {
        let near = if self.told_std { self.rel_std } else { 0.002 };
        let mut world = self.told.clone();
        world.weight *= 1.0 + near * random.normal().clamp(-2.5, 2.5);
        world.centre = world
            .centre
            .map(|r| r * (1.0 + near * random.normal().clamp(-2.5, 2.5)));
        if !self.told_nominal {
            world = self.told.clone();
        }
        world
    }

    fn last(&self) -> f64 {
        self.rows[self.rows.len() - 1].1
    }

    fn record(&self, world: &World) -> Record {
        self.rows
            .iter()
            .map(|(point, _)| world.read(self.poses[*point]))
            .collect()
    }

    /// Over the noise, one after the other, with `tail` for what the file says beforehand.
    fn flat(&self, record: &Record, tail: &[f64]) -> Vec<f64> {
        let one = |row: &[f64; 6]| {
            (0..6)
                .map(|i| row[i] / self.noise[i / 3])
                .collect::<Vec<f64>>()
        };
        let mut all: Vec<f64> = record.iter().flat_map(one).collect();
        all.extend(tail);
        all
    }

    fn change(&self, base: &World, changed: &World) -> Record {
        let one = |(a, b): ([f64; 6], [f64; 6])| std::array::from_fn(|i| b[i] - a[i]);
        self.record(base)
            .into_iter()
            .zip(self.record(changed))
            .map(one)
            .collect()
    }

    /// What is free on a clean day: weight and centre, as far as the file says.
    fn free(&self, base: &World) -> Vec<Vec<f64>> {
        let step = 1e-4;
        let near = if self.told_std { self.rel_std } else { 0.02 };
        let column = |i: usize| {
            let mut world = base.clone();
            match i {
                0 => world.weight *= 1.0 + step,
                _ => world.centre[i - 1] += step * norm(base.centre),
            }
            let tail: [f64; 4] = std::array::from_fn(|k| {
                if k == i && self.told_nominal {
                    step / near
                } else {
                    0.0
                }
            });
            self.flat(&self.change(base, &world), &tail)
        };
        (0..4).map(column).collect()
    }

    /// Every cause that is one change of the world, as columns.
    fn rivals(&self, base: &World) -> Vec<(&'static str, Vec<Vec<f64>>)> {
        let of = |change: &dyn Fn(&mut World)| {
            let mut world = base.clone();
            change(&mut world);
            self.flat(&self.change(base, &world), &[0.0; 4])
        };
        let mut all: Vec<(&'static str, Vec<Vec<f64>>)> = vec![
            (
                "sensor_offset",
                (0..6).map(|i| of(&|w| w.offset[i] += 1.0)).collect(),
            ),
            ("tool_weight", vec![of(&|w| w.weight *= 1.001)]),
            (
                "centre_of_mass",
                (0..3).map(|i| of(&|w| w.centre[i] += 1e-4)).collect(),
            ),
            (
                "sensor_rotation",
                (0..3)
                    .map(|i| of(&|w| w.mounting = turn(axis(i), 1e-4)))
                    .collect(),
            ),
            (
                "base_tilt",
                (0..2)
                    .map(|i| of(&|w| w.down = turned(turn(axis(i), 1e-4), w.down)))
                    .collect(),
            ),
        ];
        for i in 0..3 {
            all.push(("force_gain", vec![of(&|w| w.matrix[i][i] += 1e-3)]));
        }
        for (i, j) in (0..6)
            .flat_map(|i| (0..6).map(move |j| (i, j)))
            .filter(|(i, j)| i != j)
        {
            all.push(("cross_talk", vec![of(&|w| w.matrix[i][j] += 1e-3)]));
        }
        for share in [0.3, 2.0] {
            let rise = |i: usize| {
                let row = |(_, t): &(usize, f64)| {
                    let rise = 1.0 - (-t / (share * self.last())).exp();
                    std::array::from_fn(|k| if k == i { rise } else { 0.0 })
                };
                self.flat(&self.rows.iter().map(row).collect(), &[0.0; 4])
            };
            all.push(("thermal_drift", (0..6).map(rise).collect()));
        }
        all
    }
}

/// A pull of a hose on the tool, base axes in, sensor axes out: force and moment.
type Pull = Box<dyn Fn(Quat) -> ([f64; 6], f64)>;

fn hose(habit: &Habit, random: &mut Random) -> (Pull, &'static str) {
    let at = [
        0.05 * random.normal(),
        0.05 * random.normal(),
        random.uniform(0.05, 0.2),
    ];
    let hook = [
        random.uniform(-0.5, 0.5),
        random.uniform(-0.5, 0.5),
        random.uniform(0.4, 0.9),
    ];
    let form = random.below(3);
    let slack = norm(hook) * random.uniform(0.9, 1.05);
    let name = [
        "slack until taut",
        "pull that grows with the square",
        "bends with the turn of A6",
    ][form];
    let weight = habit.told.weight;
    let pull = move |pose: Quat| {
        let to_sensor = super::algebra::inverse(pose);
        let way = minus(hook, turned(pose, at));
        let length = norm(way);
        let size = match form {
            0 => (length - slack).max(0.0) / 0.05,
            1 => (length / 0.5).powi(2),
            _ => 0.3,
        };
        let force = turned(to_sensor, scaled(unit(way), size));
        let mut moment = cross(at, force);
        if form == 2 {
            // The hose lies along the sensor's z and resists being wound: the angle of swing and twist.
            let wound = 2.0 * pose[3].atan2(pose[0]);
            let wound = if wound > PI {
                wound - TAU
            } else if wound < -PI {
                wound + TAU
            } else {
                wound
            };
            moment = plus(moment, scaled(axis(2), 0.2 * wound));
        }
        (
            [
                force[0], force[1], force[2], moment[0], moment[1], moment[2],
            ],
            weight,
        )
    };
    (Box::new(pull), name)
}

/// A change of the world at a size.
type Change = Box<dyn Fn(&mut World, f64)>;

/// A cause: the change of every row at unit size, and what it is.
struct Hidden {
    effect: &'static str,
    site: Option<String>,
    law: String,
    /// Change of the world at a size, where it is one.
    world: Option<Change>,
    /// Added to the readings at a size.
    added: Option<Record>,
    /// Size that may count as one.
    scale: f64,
}

fn world_change(
    effect: &'static str,
    law: String,
    scale: f64,
    change: impl Fn(&mut World, f64) + 'static,
) -> Hidden {
    Hidden {
        effect,
        site: None,
        law,
        world: Some(Box::new(change)),
        added: None,
        scale,
    }
}

fn added(effect: &'static str, law: String, record: Record) -> Hidden {
    Hidden {
        effect,
        site: None,
        law,
        world: None,
        added: Some(record),
        scale: 1.0,
    }
}

fn hidden(effect: &'static str, habit: &Habit, real: &World, random: &mut Random) -> Hidden {
    let direction = unit([random.normal(), random.normal(), random.normal()]);
    match effect {
        "tool_weight" => world_change(effect, "weight".into(), 0.01, |w, s| w.weight *= 1.0 + s),
        "centre_of_mass" => world_change(effect, "centre".into(), 0.005, move |w, s| {
            w.centre = plus(w.centre, scaled(direction, s))
        }),
        "sensor_offset" => {
            let (channels, noise) = (1 + random.below(6), habit.noise);
            let mut set = [0.0; 6];
            for _ in 0..channels {
                let i = random.below(6);
                set[i] = random.normal() * noise[i / 3];
            }
            world_change(effect, "zero".into(), 1.0, move |w, s| {
                (0..6).for_each(|i| w.offset[i] += s * set[i])
            })
        }
        "sensor_rotation" => world_change(effect, "mounted turned".into(), 0.01, move |w, s| {
            w.mounting = turn(direction, s)
        }),
        "base_tilt" => {
            let about = unit([random.normal(), random.normal(), 0.0]);
            world_change(effect, "base not level".into(), 0.01, move |w, s| {
                w.down = turned(turn(about, s), w.down)
            })
        }
        "force_gain" => {
            let i = random.below(3);
            let mut cause = world_change(
                effect,
                format!("gain of {}", ["x", "y", "z"][i]),
                0.01,
                move |w, s| w.matrix[i][i] += s,
            );
            cause.site = Some(["sensor-x", "sensor-y", "sensor-z"][i].into());
            cause
        }
        "cross_talk" => {
            let (i, j) = *pick(
                random,
                &[
                    (0, 1),
                    (0, 2),
                    (1, 0),
                    (1, 2),
                    (2, 0),
                    (2, 1),
                    (3, 2),
                    (4, 0),
                    (5, 2),
                    (5, 0),
                    (3, 1),
                ],
            );
            world_change(
                effect,
                format!("channel {i} of channel {j}"),
                0.01,
                move |w, s| w.matrix[i][j] += s,
            )
        }
        "hose_force" => {
            let (pull, law) = hose(habit, random);
            let rows = habit
                .rows
                .iter()
                .map(|(p, _)| pull(habit.poses[*p]).0)
                .collect();
            added(effect, law.into(), rows)
        }
        "thermal_drift" => drift(habit, random),
        "outlier_point" => {
            let point = random.below(habit.poses.len());
            let change: [f64; 6] = std::array::from_fn(|i| random.normal() * habit.noise[i / 3]);
            let row = |(p, _): &(usize, f64)| if *p == point { change } else { [0.0; 6] };
            let mut cause = added(
                effect,
                "a hand on the tool".into(),
                habit.rows.iter().map(row).collect(),
            );
            cause.site = habit.numbered.then(|| format!("point{}", point + 1));
            cause
        }
        other => outside(other, habit, real, random),
    }
}

fn drift(habit: &Habit, random: &mut Random) -> Hidden {
    let share: [f64; 6] = std::array::from_fn(|i| {
        random.normal() * habit.noise[i / 3] * f64::from(u8::from(chance(random, 0.6)))
    });
    let (form, fast) = (random.below(3), random.uniform(0.2, 0.8));
    let last = habit.last();
    let rise = |t: f64| match form {
        0 => 1.0 - (-t / (fast * last)).exp(),
        1 => (t / last).sqrt(),
        _ => t / last * (1.0 + 0.4 * fast * (1.0 - t / last)),
    };
    let row = |(_, t): &(usize, f64)| {
        let r = rise(*t);
        std::array::from_fn(|i| (share[i] + if i == 2 { 1e-3 * habit.noise[0] } else { 0.0 }) * r)
    };
    added(
        "thermal_drift",
        ["warms up", "root of time", "nearly steady"][form].into(),
        habit.rows.iter().map(row).collect(),
    )
}

fn outside(name: &str, habit: &Habit, real: &World, random: &mut Random) -> Hidden {
    let w = real.weight;
    let (i, way) = (
        random.below(3),
        unit([random.normal(), random.normal(), random.normal()]),
    );
    let clean = habit.record(real);
    let middle = habit.last() * random.uniform(0.35, 0.65);
    let jump: [f64; 6] = std::array::from_fn(|i| random.normal() * habit.noise[i / 3]);
    let row = |k: usize| -> [f64; 6] {
        let read = clean[k];
        let force = [read[0], read[1], read[2]];
        match name {
            // A part in the tool falls from stop to stop.
            "loose part in the tool" => {
                let side = if super::algebra::dot(&force, &way) > 0.0 {
                    1.0
                } else {
                    -1.0
                };
                let moment = cross(scaled(way, side), force);
                [0.0, 0.0, 0.0, moment[0], moment[1], moment[2]]
            }
            // An amplifier that bends.
            "channel bends" => std::array::from_fn(|c| {
                if c == i {
                    read[c].abs().powf(2.5) / w.powf(1.5) * read[c].signum()
                } else {
                    0.0
                }
            }),
            // The cable was touched between two points: all zeros jump once.
            "zeros jump" => std::array::from_fn(|c| {
                if habit.rows[k].1 > middle {
                    jump[c]
                } else {
                    0.0
                }
            }),
            _ => unreachable!("{name}"),
        }
    };
    let rows = (0..clean.len()).map(row).collect();
    added("outside", name.into(), rows)
}

const EFFECTS: [&str; 10] = [
    "tool_weight",
    "centre_of_mass",
    "sensor_offset",
    "sensor_rotation",
    "base_tilt",
    "force_gain",
    "cross_talk",
    "hose_force",
    "thermal_drift",
    "outlier_point",
];
const OUTSIDE: [&str; 3] = ["loose part in the tool", "channel bends", "zeros jump"];

/// The size at which the largest reading of a cause is `strength` times the noise.
fn sized(cause: &Hidden, habit: &Habit, base: &World, strength: f64) -> f64 {
    let peak = |size: f64| {
        let rows = change(cause, habit, base, size);
        habit
            .flat(&rows, &[])
            .iter()
            .map(|x| x.abs())
            .fold(1e-12, f64::max)
    };
    cause.scale * strength / peak(cause.scale)
}

fn change(cause: &Hidden, habit: &Habit, base: &World, size: f64) -> Record {
    match (&cause.world, &cause.added) {
        (Some(change), _) => {
            let mut world = base.clone();
            change(&mut world, size);
            habit.change(base, &world)
        }
        (_, Some(rows)) => rows.iter().map(|row| row.map(|x| x * size)).collect(),
        _ => Vec::new(),
    }
}

/// A case.
pub fn draw(seed: u64) -> Case {
    let mut random = Random::new(seed ^ 0xf5e4_0000);
    let habit = Habit::draw(&mut random);
    let names = chosen(&mut random, USUAL, [&EFFECTS, &OUTSIDE], |name| {
        habit.told_nominal || !["tool_weight", "centre_of_mass"].contains(&name)
    });
    let mut world = habit.real(&mut random);
    let real = world.clone();
    let mut more: Record = vec![[0.0; 6]; habit.rows.len()];
    let mut all = Vec::new();
    for name in &names {
        let cause = hidden(name, &habit, &real, &mut random);
        let strength = random.log_uniform(2.0, 40.0);
        // A fault of the tool must be one against what the file claims to know of it.
        let least = match *name {
            "tool_weight" => 8.0 * if habit.told_std { habit.rel_std } else { 0.02 },
            "centre_of_mass" => {
                8.0 * norm(real.centre) * if habit.told_std { habit.rel_std } else { 0.02 }
            }
            _ => 0.0,
        };
        let sign = if chance(&mut random, 0.5) { 1.0 } else { -1.0 };
        let size = sign * sized(&cause, &habit, &real, strength).max(least);
        let rows = change(&cause, &habit, &real, size);
        match &cause.world {
            Some(change) => change(&mut world, size),
            None => more
                .iter_mut()
                .zip(&rows)
                .for_each(|(m, r)| (0..6).for_each(|i| m[i] += r[i])),
        }
        all.push((cause, rows, strength));
    }
    let truths = (0..all.len())
        .map(|i| truth(&habit, &real, &all, i))
        .collect();
    let rows = habit.record(&world);
    let rows: Record = rows
        .iter()
        .zip(&more)
        .map(|(a, b)| std::array::from_fn(|i| a[i] + b[i]))
        .collect();
    let files = vec![("weights.csv".to_string(), text(&habit, &rows, &mut random))];
    let said = format!(
        "{} poses {}, {} rows, W {:.0} N, noise {:.3} N {:.4} Nm{}{}{}{}, rounded {:.2}",
        habit.poses.len(),
        habit.way,
        habit.rows.len(),
        habit.told.weight,
        habit.noise[0],
        habit.noise[1],
        if habit.told_nominal { ", nominal" } else { "" },
        if habit.told_std {
            format!(" to {}", habit.rel_std)
        } else {
            String::new()
        },
        if habit.timed { ", timed" } else { "" },
        if habit.euler { ", angles" } else { "" },
        habit.rounding,
    );
    Case {
        seed,
        truths,
        habit: said,
        files,
    }
}

fn truth(habit: &Habit, real: &World, all: &[(Hidden, Record, f64)], i: usize) -> Truth {
    let (cause, rows, strength) = &all[i];
    let own = habit.flat(rows, &[0.0; 4]);
    let freed = |effect: &str| ["tool_weight", "centre_of_mass"].contains(&effect);
    let mut known = habit.free(real);
    known.extend(
        all.iter()
            .enumerate()
            .filter(|(j, _)| *j != i)
            .map(|(_, o)| habit.flat(&o.1, &[0.0; 4])),
    );
    let sight = length_beyond(&own, &known);
    let rival = |columns: &Vec<Vec<f64>>| {
        let with: Vec<Vec<f64>> = known.iter().chain(columns).cloned().collect();
        length_beyond(&own, &with)
    };
    let rivals = habit.rivals(real);
    // What is hidden beside it is no rival: its own change is among the known.
    let there = |name: &str| all.iter().any(|other| other.0.effect == name);
    let one = |name: &str| freed(cause.effect) && freed(name) && !habit.told_nominal;
    let near = rivals.iter().filter(|(name, _)| !there(name) && !one(name));
    let near: Vec<(f64, &str)> = near.map(|(name, c)| (rival(c), *name)).collect();
    let apart = near.iter().map(|n| n.0).fold(sight, f64::min);
    let mut twins: Vec<(&'static str, Option<String>)> = rivals
        .iter()
        .filter(|(name, c)| !there(name) && twin(rival(c), sight))
        .map(|(n, _)| (*n, None))
        .collect();
    twins.dedup();
    Truth {
        effect: cause.effect,
        site: cause.site.clone(),
        sight,
        apart,
        twins,
        strength: *strength,
        law: cause.law.clone(),
    }
}

/// A, B, C in degrees of R = Rz(a) Ry(b) Rx(c), from the turned axes.
fn angles(q: Quat) -> V3 {
    let (x, y, z) = (turned(q, axis(0)), turned(q, axis(1)), turned(q, axis(2)));
    let b = (-x[2]).clamp(-1.0, 1.0).asin();
    let upright = x[0].hypot(x[1]) > 1e-9;
    let a = if upright {
        x[1].atan2(x[0])
    } else {
        (-y[0]).atan2(y[1])
    };
    let c = if upright { y[2].atan2(z[2]) } else { 0.0 };
    [a, b, c].map(f64::to_degrees)
}

fn text(habit: &Habit, rows: &Record, random: &mut Random) -> String {
    let mut head = String::from("# kind = \"force-sensor\"\n");
    if habit.told_nominal {
        let c = habit.told.centre;
        head += &format!(
            "# nominal_weight_N = {}\n# nominal_com_m = [{}, {}, {}]\n",
            habit.told.weight, c[0], c[1], c[2]
        );
        if habit.told_std {
            head += &format!("# nominal_rel_std = {}\n", habit.rel_std);
        }
    }
    if habit.told_noise {
        head += &format!(
            "# sensor_noise_N = {}\n# sensor_noise_Nm = {}\n",
            habit.noise[0], habit.noise[1]
        );
    }
    let mut titles: Vec<&str> = Vec::new();
    if habit.numbered {
        titles.push("point");
    }
    if habit.timed {
        titles.push("time_s");
    }
    titles.extend(if habit.euler {
        &["a_deg", "b_deg", "c_deg"][..]
    } else {
        &["qw", "qx", "qy", "qz"][..]
    });
    titles.extend(["fx_N", "fy_N", "fz_N", "mx_Nm", "my_Nm", "mz_Nm"]);
    head += &titles.join(",");
    head.push('\n');
    let mut sign = 1.0;
    let mut last = usize::MAX;
    for (k, (point, time)) in habit.rows.iter().enumerate() {
        if *point != last {
            (last, sign) = (*point, if chance(random, 0.5) { 1.0 } else { -1.0 });
        }
        let mut cells = Vec::new();
        if habit.numbered {
            cells.push((point + 1).to_string());
        }
        if habit.timed {
            cells.push(format!("{time:.2}"));
        }
        let q = habit.poses[*point];
        match habit.euler {
            true => cells.extend(angles(q).map(|x| format!("{x:.6}"))),
            false => cells.extend(q.map(|x| format!("{:.9}", sign * x))),
        }
        for (i, value) in rows[k].iter().enumerate() {
            let noise = habit.noise[i / 3];
            let step = habit.rounding * noise;
            let read = value + noise * random.normal();
            cells.push(format!("{:.7}", (read / step).round() * step));
        }
        head += &cells.join(",");
        head.push('\n');
    }
    head
}

/// A file of a sensor with zeros, tool and mounting of its own, and what is true: name and value in SI units.
pub fn known(seed: u64) -> (String, Vec<(&'static str, f64)>) {
    let mut random = Random::new(seed ^ 0xf5e4_1111);
    let mut habit = Habit::draw(&mut random);
    while habit.poses.len() < 8 {
        habit = Habit::draw(&mut random);
    }
    (habit.told_nominal, habit.rounding) = (false, 1e-6);
    let mut world = habit.told.clone();
    for i in 0..6 {
        world.offset[i] = 30.0 * habit.noise[i / 3] * random.normal();
    }
    let text = text(&habit, &habit.record(&world), &mut random);
    let o = world.offset;
    let truth = vec![
        ("weight", world.weight),
        ("com_x", world.centre[0]),
        ("com_y", world.centre[1]),
        ("com_z", world.centre[2]),
        ("offset_fx", o[0]),
        ("offset_fy", o[1]),
        ("offset_fz", o[2]),
        ("offset_mx", o[3]),
        ("offset_my", o[4]),
        ("offset_mz", o[5]),
        ("rotation_x", 0.0),
        ("rotation_y", 0.0),
        ("rotation_z", 0.0),
        ("base_tilt_x", 0.0),
        ("base_tilt_y", 0.0),
    ];
    (text, truth)
}
