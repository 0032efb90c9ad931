//! Force steps at points of the workspace: an elastic robot drawn at random is loaded in every posture with finite
//! rotations, read as laboratories read, and hides a cause of the contract, two, or something from outside it.

use super::algebra::{
    Quat, V3, axis, basis, cross, dot, minus, norm, plus, scaled, turned, without,
};
use super::arm::{Arm, Line, Spring, askew, deflected};
use super::chosen::{USUAL, chosen};
use super::rigid::{across, facing};
use super::{Case, Truth, chance, pick, twin};
use ident::ground::random::Random;
use std::f64::consts::TAU;

/// What a file that says nothing may mean: springs as a catalogue has them.
const UNTOLD: f64 = 0.1;

/// One reading.
#[derive(Debug, Clone, Copy)]
struct Row {
    point: usize,
    direction: usize,
    cycle: usize,
    /// Set-up: one point and direction.
    setup: usize,
    /// Steps since the series began.
    step: f64,
    /// Force that acts, and as the load cell tells it, N.
    force: f64,
    told: f64,
}

/// What one set-up is off by.
#[derive(Debug, Clone, Copy)]
struct Setup {
    gain: f64,
    turn: Quat,
}

/// What is hidden and what is as it should be.
#[derive(Debug, Clone)]
struct World {
    springs: Vec<Spring>,
    gain: f64,
    /// How the load of each direction lies askew.
    tilt: [Quat; 3],
    /// The same, fixed to the hand.
    hand_tilt: Quat,
    sensor: V3,
    /// A point whose posture is another than the stated one.
    posture: Option<(usize, [f64; 6])>,
    /// A point that gives way otherwise: rows of a matrix (m/N) and a factor.
    odd: Option<(usize, [V3; 3], f64)>,
    /// What no linear spring does, m.
    extra: Vec<V3>,
}

/// Robot, postures, readings and the way of working.
#[derive(Debug, Clone)]
struct Habit {
    arm: Arm,
    joints_deg: Vec<[f64; 6]>,
    rows: Vec<Row>,
    setups: Vec<Setup>,
    /// Target of the lasers, in the frame of the flange at zero.
    target: V3,
    /// Spread of the springs as the file tells it, and as it is.
    told_near: Option<f64>,
    near: f64,
    told_repeat: Option<f64>,
    repeat: f64,
    askew: f64,
    noise: f64,
    told_noise: bool,
    growth: f64,
    drift: f64,
    tared: bool,
    cell: f64,
    rounding: f64,
    gaps: bool,
    /// Which components are read: all, along the force, or all but one.
    read: &'static str,
    dropped: usize,
    german: bool,
}

/// A rival: effect, site and what it does, row by row, for one unit.
type Rival = (&'static str, Option<String>, Vec<Vec<V3>>);
/// The same as the best test sees it.
type Seen = (&'static str, Option<String>, Vec<Vec<f64>>);

impl Habit {
    fn joints(&self, world: &World, point: usize) -> [f64; 6] {
        let off = match world.posture {
            Some((p, off)) if p == point => off,
            _ => [0.0; 6],
        };
        std::array::from_fn(|j| (self.joints_deg[point][j] + off[j]).to_radians())
    }

    fn stated(&self, point: usize) -> [f64; 6] {
        self.joints_deg[point].map(f64::to_radians)
    }

    fn target_at(&self, joints: &[f64; 6]) -> V3 {
        super::rigid::postured(&self.arm.frame, joints, 6, self.target)
    }

    /// Displacements of the target, m; with what each set-up is off by or as if all were right.
    fn readings(&self, world: &World, real: bool) -> Vec<V3> {
        let mut all = vec![[0.0; 3]; self.rows.len()];
        let mut first = 0;
        while first < self.rows.len() {
            let point = self.rows[first].point;
            let joints = self.joints(world, point);
            let lines: Vec<(Line, f64)> = world
                .springs
                .iter()
                .map(|s| (self.arm.line(s, &joints), s.stiffness))
                .collect();
            let (hand, target) = (self.arm.hand(&joints), self.target_at(&joints));
            let target = if real { target } else { hand };
            let mut known: Vec<(usize, f64, V3)> = Vec::new();
            let mut i = first;
            while i < self.rows.len() && self.rows[i].point == point {
                let r = self.rows[i];
                let same = known.iter().find(|k| k.0 == r.setup && k.1 == r.force);
                let d = match same {
                    Some(k) => k.2,
                    None => {
                        let load = self.load(world, &r, real);
                        let d = deflected(&lines, hand, target, load);
                        known.push((r.setup, r.force, d));
                        d
                    }
                };
                all[i] = self.seen(world, i, d);
                i += 1;
            }
            first = i;
        }
        all
    }

    fn load(&self, world: &World, r: &Row, real: bool) -> V3 {
        let load = scaled(axis(r.direction), r.force * world.gain);
        let load = turned(world.tilt[r.direction], load);
        let about = [1, 2, 3].map(|k| world.hand_tilt[k]);
        let about = facing(&self.arm.frame, &self.stated(r.point), 6, about);
        let load = turned([world.hand_tilt[0], about[0], about[1], about[2]], load);
        match real {
            true => scaled(
                turned(self.setups[r.setup].turn, load),
                self.setups[r.setup].gain,
            ),
            false => load,
        }
    }

    fn seen(&self, world: &World, i: usize, d: V3) -> V3 {
        let r = &self.rows[i];
        let mut d = plus(d, world.extra[i]);
        if let Some((point, c, factor)) = world.odd.filter(|o| o.0 == r.point) {
            let load = scaled(axis(r.direction), r.force);
            debug_assert_eq!(point, r.point);
            d = plus(scaled(d, factor), c.map(|row| dot(&row, &load)));
        }
        std::array::from_fn(|k| d[k] * world.sensor[k])
    }

    /// A small turn of unit size times what `angle` says, by every row: what the hand does.
    fn by_line(&self, spring: &Spring, angle: impl Fn(usize, f64) -> f64) -> Vec<V3> {
        let mut cached: Option<(usize, Line, V3)> = None;
        let mut all = Vec::with_capacity(self.rows.len());
        for (i, r) in self.rows.iter().enumerate() {
            let (_, line, hand) = *match &mut cached {
                Some(c) if c.0 == r.point => c,
                c => {
                    let q = self.stated(r.point);
                    c.insert((r.point, self.arm.line(spring, &q), self.arm.hand(&q)))
                }
            };
            let arm = minus(hand, line.1);
            let moment = dot(&line.0, &cross(arm, scaled(axis(r.direction), r.force)));
            all.push(scaled(cross(line.0, arm), angle(i, moment)));
        }
        all
    }

    fn soft(&self, spring: &Spring) -> Vec<V3> {
        self.by_line(spring, |_, m| m / spring.stiffness)
    }

    fn difference(&self, with: &World, base: &World) -> Vec<V3> {
        let (a, b) = (self.readings(with, false), self.readings(base, false));
        a.iter().zip(b).map(|(a, b)| minus(*a, b)).collect()
    }

    /// What is read of a row.
    fn is_read(&self, r: &Row, k: usize) -> bool {
        match self.read {
            "along the force" => k == r.direction,
            "two" => k != self.dropped || k == r.direction,
            _ => true,
        }
    }
}

/// Takes out of every vector what the laboratory's own errors explain, and puts it in standard deviations.
struct Sieve<'a> {
    habit: &'a Habit,
    scale: Vec<f64>,
    /// Unit vectors over parts of the readings, and what is taken of them.
    marks: Vec<(Vec<(usize, f64)>, f64)>,
}

impl<'a> Sieve<'a> {
    fn new(habit: &'a Habit, base: &[V3]) -> Self {
        let most = habit.rows.iter().fold(0.0_f64, |m, r| m.max(r.force.abs()));
        let scale = habit.rows.iter().map(|r| {
            let grown = habit.noise * (1.0 + habit.growth * r.force.abs() / most);
            grown.hypot(habit.rounding / 12.0_f64.sqrt())
        });
        let mut own = Self {
            habit,
            scale: scale.collect(),
            marks: Vec::new(),
        };
        own.mark_cell(base, most);
        own.mark_series();
        own.mark_setups(base);
        own
    }

    /// An error of standard deviation one, as it shows in the readings.
    fn mark(&mut self, error: Vec<(usize, f64)>) {
        let mut own: Vec<(usize, f64)> = error
            .into_iter()
            .filter(|(at, _)| self.habit.is_read(&self.habit.rows[at / 3], at % 3))
            .map(|(at, x)| (at, x / self.scale[at / 3]))
            .collect();
        let Some((low, high)) = own.first().zip(own.last()).map(|(a, b)| (a.0, b.0)) else {
            return;
        };
        let mut dense = vec![0.0; high - low + 1];
        own.iter().for_each(|(at, x)| dense[at - low] = *x);
        for (other, taken) in &self.marks {
            if other[0].0 > high || other[other.len() - 1].0 < low {
                continue;
            }
            let inside = |at: usize| (low..=high).contains(&at);
            let share: f64 = other
                .iter()
                .filter(|(at, _)| inside(*at))
                .map(|(at, x)| x * dense[at - low])
                .sum();
            other
                .iter()
                .filter(|(at, _)| inside(*at))
                .for_each(|(at, x)| dense[at - low] -= taken * share * x);
        }
        own.iter_mut().for_each(|(at, x)| *x = dense[*at - low]);
        let size = own.iter().map(|(_, x)| x * x).sum::<f64>().sqrt();
        if size > 1e-9 {
            own.iter_mut().for_each(|(_, x)| *x /= size);
            self.marks
                .push((own, 1.0 - 1.0 / (1.0 + size * size).sqrt()));
        }
    }

    fn mark_cell(&mut self, base: &[V3], most: f64) {
        let step = self.habit.cell / 12.0_f64.sqrt();
        for (i, r) in self.habit.rows.iter().enumerate() {
            if step > 0.0 && r.force.abs() > 0.05 * most {
                let error = scaled(base[i], step / r.force);
                self.mark((0..3).map(|k| (3 * i + k, error[k])).collect());
            }
        }
    }

    fn mark_series(&mut self) {
        let mut start = 0;
        let rows = &self.habit.rows;
        while start < rows.len() {
            let key = |r: &Row| (r.setup, r.cycle);
            let end = (start..rows.len())
                .find(|i| key(&rows[*i]) != key(&rows[start]))
                .unwrap_or(rows.len());
            let zero = if self.habit.tared {
                self.habit.noise
            } else {
                0.0
            };
            for k in 0..3 {
                let of =
                    |f: &dyn Fn(usize) -> f64| (start..end).map(|i| (3 * i + k, f(i))).collect();
                if zero > 0.0 {
                    let all = of(&|_| zero);
                    self.mark(all);
                }
                if self.habit.drift > 0.0 {
                    let last = rows[end - 1].step.max(1.0);
                    let all = of(&|i| self.habit.drift * rows[i].step / last);
                    self.mark(all);
                }
            }
            start = end;
        }
    }

    fn mark_setups(&mut self, base: &[V3]) {
        let rows = &self.habit.rows;
        for setup in 0..self.habit.setups.len() {
            let own: Vec<usize> = (0..rows.len())
                .filter(|i| rows[*i].setup == setup)
                .collect();
            let each = |d: &dyn Fn(usize) -> V3| {
                let of = |i: &usize| {
                    let d = d(*i);
                    (0..3).map(|k| (3 * i + k, d[k])).collect::<Vec<_>>()
                };
                own.iter().flat_map(of).collect::<Vec<_>>()
            };
            let repeat = self.habit.told_repeat.unwrap_or(self.habit.repeat);
            let all = each(&|i| scaled(base[i], repeat));
            self.mark(all);
        }
    }

    /// A vector of displacements as the best test sees it, and the stated springs below it.
    fn of(&self, v: &[V3], tail: &[f64]) -> Vec<f64> {
        let mut own = vec![0.0; 3 * v.len()];
        for (i, d) in v.iter().enumerate() {
            for k in 0..3 {
                if self.habit.is_read(&self.habit.rows[i], k) {
                    own[3 * i + k] = d[k] / self.scale[i];
                }
            }
        }
        for (mark, taken) in &self.marks {
            let share: f64 = mark.iter().map(|(at, x)| x * own[*at]).sum();
            mark.iter()
                .for_each(|(at, x)| own[*at] -= taken * share * x);
        }
        own.extend(tail);
        own
    }
}

impl Habit {
    fn draw(random: &mut Random) -> Self {
        let arm = Arm::draw(random);
        let points = 4 + random.below(12);
        let joints_deg = postures(&arm, points, random);
        let told_near = chance(random, 0.7).then(|| *pick(random, &[0.02, 0.05, 0.1]));
        let told_repeat =
            chance(random, 0.6).then(|| (random.log_uniform(0.004, 0.02) * 1e4).round() / 1e4);
        let share = if chance(random, 0.2) {
            random.uniform(0.0, 0.06)
        } else {
            0.0
        };
        let target = plus(
            scaled(arm.frame.tcp, 1.0 - share),
            scaled(arm.frame.flange, share),
        );
        let mut own = Self {
            joints_deg,
            rows: Vec::new(),
            setups: Vec::new(),
            target,
            told_near,
            near: told_near.unwrap_or(0.02),
            told_repeat,
            repeat: told_repeat.unwrap_or_else(|| random.uniform(0.001, 0.008)),
            askew: if chance(random, 0.3) {
                random.uniform(0.001, 0.005)
            } else {
                0.0
            },
            noise: random.log_uniform(1e-6, 8e-6),
            told_noise: chance(random, 0.6),
            growth: if chance(random, 0.4) {
                random.uniform(0.3, 2.5)
            } else {
                0.0
            },
            drift: 0.0,
            tared: chance(random, 0.4),
            cell: *pick(random, &[0.0, 0.0, 0.5, 2.0, 5.0]),
            rounding: *pick(random, &[1e-8, 1e-7, 1e-6]),
            gaps: chance(random, 0.15),
            read: *pick(random, &["all", "all", "all", "along the force", "two"]),
            dropped: random.below(3),
            german: chance(random, 0.2),
            arm,
        };
        if chance(random, 0.5) {
            own.drift = own.noise * random.uniform(0.5, 3.0);
        }
        own.draw_rows(points, random);
        own
    }

    fn draw_rows(&mut self, points: usize, random: &mut Random) {
        let most = (random.uniform(300.0, 1500.0) * self.arm.scale.sqrt() / 50.0).round() * 50.0;
        let steps = 3 + random.below(10);
        let both = chance(random, 0.6);
        let back = chance(random, 0.8);
        let cycles = 1 + random.below(3);
        let directions: Vec<usize> = match random.below(10) {
            0..7 => vec![0, 1, 2],
            7 | 8 => vec![random.below(2), 2],
            _ => vec![random.below(3)],
        };
        let by_hand = chance(random, 0.3);
        let some = chance(random, 0.2);
        let levels = levels(most, steps, both, back);
        for point in 0..points {
            for &direction in &directions {
                if some && directions.len() > 1 && chance(random, 0.15) {
                    continue;
                }
                let setup = self.setups.len();
                let angle = self.askew * random.normal().abs();
                self.setups.push(Setup {
                    gain: 1.0 + self.repeat * random.normal().clamp(-2.5, 2.5),
                    turn: askew(random, angle),
                });
                for cycle in 0..cycles {
                    for (n, level) in levels.iter().enumerate() {
                        let off = if by_hand && *level != 0.0 {
                            0.02 * most * random.uniform(-1.0, 1.0)
                        } else {
                            0.0
                        };
                        // Weights hang as they are; what a cell reads is rounded.
                        let force = ((level + off) * 10.0).round() / 10.0;
                        let told = match self.cell {
                            0.0 => force,
                            step => (force / step).round() * step,
                        };
                        self.rows.push(Row {
                            point,
                            direction,
                            cycle,
                            setup,
                            step: n as f64,
                            force,
                            told,
                        });
                    }
                }
            }
        }
    }
}

fn levels(most: f64, steps: usize, both: bool, back: bool) -> Vec<f64> {
    let up: Vec<f64> = (0..=steps)
        .map(|i| most * i as f64 / steps as f64)
        .collect();
    let down: Vec<f64> = up.iter().rev().skip(1).copied().collect();
    let mut all = up.clone();
    if back || both {
        all.extend(&down);
    }
    if both {
        all.extend(up.iter().skip(1).map(|f| -f));
        if back {
            all.extend(down.iter().map(|f| -f));
        }
    }
    all
}

fn postures(arm: &Arm, points: usize, random: &mut Random) -> Vec<[f64; 6]> {
    let wide = *pick(random, &[0.4, 1.0, 1.0, 1.5]);
    let wrist = chance(random, 0.6);
    let mut all = Vec::new();
    while all.len() < points {
        let mut q: [f64; 6] = std::array::from_fn(|j| {
            let spread = wide * [35.0, 20.0, 20.0, 30.0, 18.0, 40.0][j];
            let moves = j < 3 || wrist || j == 4;
            arm.home_deg[j]
                + if moves {
                    random.uniform(-spread, spread)
                } else {
                    0.0
                }
        });
        q = q.map(|d| (d * 100.0).round() / 100.0);
        let hand = arm.hand(&q.map(f64::to_radians));
        let foot = arm.ground[2];
        // Not in the floor and not on the axis of the base.
        if dot(&hand, &foot) > 0.1 && norm(minus(hand, scaled(foot, dot(&hand, &foot)))) > 0.4 {
            all.push(q);
        }
    }
    all
}

impl World {
    fn told(habit: &Habit) -> Self {
        Self {
            springs: habit.arm.springs.clone(),
            gain: 1.0,
            tilt: [[1.0, 0.0, 0.0, 0.0]; 3],
            hand_tilt: [1.0, 0.0, 0.0, 0.0],
            sensor: [1.0; 3],
            posture: None,
            odd: None,
            extra: vec![[0.0; 3]; habit.rows.len()],
        }
    }

    fn insert(&mut self, springs: Vec<Spring>) {
        self.springs.extend(springs);
        self.springs.sort_by(|a, b| a.rank.total_cmp(&b.rank));
    }
}

const EFFECTS: [&str; 11] = [
    "drive_stiffness",
    "tilt_stiffness",
    "missing_tilt",
    "base_compliance",
    "link_compliance",
    "tool_compliance",
    "force_gain",
    "sensor_gain",
    "load_misalignment",
    "outlier_point",
    "backlash",
];
const OUTSIDE: [&str; 8] = [
    "flange slides on a spring",
    "foot slides on a spring",
    "play at the tool",
    "stiffness with the angle",
    "base bolt slips",
    "laser stand rubs",
    "joint creeps",
    "drive hardens",
];

fn fits(name: &str, habit: &Habit) -> bool {
    let has = |effect: &str| habit.arm.springs.iter().any(|s| s.effect == effect);
    let bearings = habit
        .arm
        .springs
        .iter()
        .filter(|s| s.effect == "tilt_stiffness")
        .count();
    match name {
        "tilt_stiffness" => has("tilt_stiffness"),
        "missing_tilt" => bearings < 12,
        "base_compliance" => !has("base_compliance"),
        "stiffness with the angle" => habit.joints_deg.len() > 5,
        _ => true,
    }
}

/// Puts a cause in place; where, and its law.
fn place(
    name: &str,
    habit: &Habit,
    world: &mut World,
    random: &mut Random,
) -> (Option<String>, String) {
    let arm = &habit.arm;
    match name {
        "drive_stiffness" | "tilt_stiffness" => change_spring(name, habit, world, random),
        "missing_tilt" => {
            let free: Vec<usize> = (0..6)
                .filter(|j| {
                    arm.stiffness("tilt_stiffness", &format!("A{}", j + 1))
                        .is_none()
                })
                .collect();
            let j = *pick(random, &free);
            let k =
                arm.scale * random.log_uniform(0.4, 3.0) * [1.3e7, 2e7, 3e6, 1.9e6, 7e5, 1.5e6][j];
            let of = arm.bearing(j, k);
            world.insert(of);
            (Some(format!("A{}", j + 1)), format!("{k:.1e} Nm/rad"))
        }
        "base_compliance" => {
            let k = arm.scale * random.log_uniform(4e6, 4e7);
            let ratio = if chance(random, 0.5) {
                1.0
            } else {
                random.uniform(0.5, 2.0)
            };
            let foot = if chance(random, 0.7) {
                [0.0; 3]
            } else {
                scaled(arm.ground[2], random.uniform(-0.2, 0.1))
            };
            world.insert(arm.soft_base(k, ratio, foot));
            (
                Some("base".into()),
                format!("{k:.1e} Nm/rad, ratio {ratio:.2}"),
            )
        }
        "link_compliance" => {
            let link = *pick(random, &[1, 2, 2, 2, 3, 3, 3]);
            let k = arm.scale * random.log_uniform(1e6, 1.2e7) * [0.0, 4.0, 2.0, 1.0][link];
            let beam = chance(random, 0.5);
            let twist = chance(random, 0.4);
            world.insert(arm.bend(link, k, beam, twist));
            let law = format!(
                "{} {k:.1e} Nm/rad{}",
                if beam { "beam" } else { "hinge" },
                if twist { " and twist" } else { "" }
            );
            (Some(format!("link{link}")), law)
        }
        "tool_compliance" => {
            let k = arm.scale * random.log_uniform(4e4, 6e5);
            let ratio = if chance(random, 0.6) {
                1.0
            } else {
                random.uniform(0.5, 2.0)
            };
            world.insert(arm.soft_tool(k, ratio));
            (
                Some("tool".into()),
                format!("{k:.1e} Nm/rad, ratio {ratio:.2}"),
            )
        }
        "force_gain" => {
            world.gain = off_by(random, 0.03, 0.25);
            (None, format!("{:.3}", world.gain))
        }
        "sensor_gain" => {
            let whole = chance(random, 0.15);
            let k = random.below(3);
            let by = off_by(random, 0.03, 0.25);
            (0..3)
                .filter(|i| whole || *i == k)
                .for_each(|i| world.sensor[i] = by);
            let site = (!whole).then(|| format!("sensor-{}", ["x", "y", "z"][k]));
            (site, format!("{by:.3}"))
        }
        "load_misalignment" => {
            let angle = random.log_uniform(0.015, 0.12);
            let q = askew(random, angle);
            if chance(random, 0.25) {
                world.hand_tilt = q;
                return (
                    None,
                    format!("{:.1} deg, fixed to the hand", angle.to_degrees()),
                );
            }
            let only =
                chance(random, 0.4).then(|| habit.rows[random.below(habit.rows.len())].direction);
            for k in 0..3 {
                if only.is_none_or(|o| o == k) {
                    world.tilt[k] = q;
                }
            }
            let whose = only.map_or("all".to_string(), |o| {
                format!("along {}", ["x", "y", "z"][o])
            });
            (None, format!("{:.1} deg, {whose}", angle.to_degrees()))
        }
        "outlier_point" => outlier(habit, world, random),
        _ => backlash(habit, world, random),
    }
}

fn off_by(random: &mut Random, low: f64, high: f64) -> f64 {
    let by = random.log_uniform(low, high);
    1.0 + if chance(random, 0.5) { by } else { -by }
}

fn change_spring(
    name: &str,
    habit: &Habit,
    world: &mut World,
    random: &mut Random,
) -> (Option<String>, String) {
    let mut sites: Vec<String> = world
        .springs
        .iter()
        .filter(|s| s.effect == name && s.told)
        .map(|s| s.site.clone())
        .collect();
    sites.dedup();
    let site = pick(random, &sites).clone();
    let least = habit.told_near.unwrap_or(UNTOLD).max(0.03);
    let by = 1.0 + random.log_uniform(5.0 * least, 2.5);
    let softer = chance(random, 0.75);
    world
        .springs
        .iter_mut()
        .filter(|s| s.effect == name && s.site == site)
        .for_each(|s| {
            if softer {
                s.stiffness /= by
            } else {
                s.stiffness *= by
            }
        });
    let word = if softer { "softer" } else { "stiffer" };
    (Some(site), format!("{by:.2} times {word}"))
}

fn outlier(habit: &Habit, world: &mut World, random: &mut Random) -> (Option<String>, String) {
    let point = random.below(habit.joints_deg.len());
    let site = Some(format!("point{}", point + 1));
    let law = match random.below(3) {
        0 => {
            let mut off = [0.0; 6];
            for _ in 0..2 {
                let by = random.uniform(3.0, 15.0) * if chance(random, 0.5) { 1.0 } else { -1.0 };
                off[random.below(5)] = by;
            }
            world.posture = Some((point, off));
            format!("posture off by {off:.0?} deg")
        }
        1 => {
            let by = off_by(random, 0.12, 0.5);
            world.odd = Some((point, [[0.0; 3]; 3], by));
            format!("displacements times {by:.2}")
        }
        _ => {
            let w = askew(random, 1.0);
            let w = super::algebra::unit([w[1], w[2], w[3]]);
            let c = random.log_uniform(2e-8, 4e-7) / habit.arm.scale;
            world.odd = Some((point, w.map(|x| scaled(w, x * c)), 1.0));
            format!("a fixture gives way by {:.0} nm/N", c * 1e9)
        }
    };
    (site, law)
}

/// Lost motion of a drive: free, so that weight may hold it at one flank, or held by friction wherever it was left.
fn backlash(habit: &Habit, world: &mut World, random: &mut Random) -> (Option<String>, String) {
    for _ in 0..20 {
        let j = random.below(6);
        let site = format!("A{}", j + 1);
        let drive = habit
            .arm
            .springs
            .iter()
            .find(|s| s.effect == "drive_stiffness" && s.site == site);
        let drive = drive.unwrap().clone();
        let held = chance(random, 0.3);
        let contact = random.uniform(0.01, 0.08);
        let unit = lost_motion(habit, &drive, j, held, contact);
        let peak = unit.iter().flatten().fold(0.0_f64, |m, x| m.max(x.abs()));
        if peak < 1e-4 {
            continue;
        }
        let gap = (random.log_uniform(3.0, 40.0) * habit.noise / peak).min(6e-4);
        for (e, u) in world.extra.iter_mut().zip(&unit) {
            *e = plus(*e, scaled(*u, gap));
        }
        let how = if held { "held by friction" } else { "free" };
        return (Some(site), format!("gap {:.0} urad {how}", 1e6 * gap));
    }
    (Some("A1".into()), "none to be seen".into())
}

/// What half a radian of play to either side does at the hand, from the unloaded place.
fn lost_motion(habit: &Habit, drive: &Spring, j: usize, held: bool, contact: f64) -> Vec<V3> {
    let weights: Vec<f64> = (0..habit.joints_deg.len())
        .map(|p| habit.arm.weight_moment(j, &habit.stated(p)))
        .collect();
    let most = moments(habit, drive)
        .iter()
        .fold(1e-9_f64, |m, x| m.max(x.abs()));
    let near = contact * most;
    let side = std::cell::Cell::new((usize::MAX, 0.0, 0.0));
    habit.by_line(drive, |i, moment| {
        let r = &habit.rows[i];
        let whole = weights[r.point] + moment;
        let free = |m: f64| 0.5 * (m / near).clamp(-1.0, 1.0);
        if !held {
            return free(whole) - free(weights[r.point]);
        }
        let (series, at, zero) = side.get();
        let now = r.setup * 8 + r.cycle;
        let start = free(weights[r.point]);
        let (at, zero) = if series == now {
            (at, zero)
        } else {
            (start, start)
        };
        // It leaves its side only once the moment overcomes the friction.
        let at = match whole {
            m if m > near => 0.5,
            m if m < -near => -0.5,
            _ => at,
        };
        side.set((now, at, zero));
        at - zero
    })
}

fn moments(habit: &Habit, spring: &Spring) -> Vec<f64> {
    let all = std::cell::RefCell::new(Vec::new());
    habit.by_line(spring, |_, m| {
        all.borrow_mut().push(m);
        0.0
    });
    all.into_inner()
}

/// A play operator over the rows of each series, of half width `w`, from rest.
fn play(habit: &Habit, u: &[f64], w: f64) -> Vec<f64> {
    let (mut at, mut series) = (0.0_f64, usize::MAX);
    let mut all = Vec::new();
    for (r, u) in habit.rows.iter().zip(u) {
        let now = r.setup * 8 + r.cycle;
        if now != series {
            (at, series) = (0.0, now);
        }
        at = at.max(u - w).min(u + w);
        all.push(at);
    }
    all
}

/// What nobody in the library explains, of unit size in its own way.
fn outside(name: &str, habit: &Habit, random: &mut Random) -> (Vec<V3>, String) {
    let arm = &habit.arm;
    let flange = |r: &Row, v: V3| facing(&arm.frame, &habit.stated(r.point), 6, v);
    let direction = askew(random, 1.0);
    let w = super::algebra::unit([direction[1], direction[2], direction[3]]);
    let load = |r: &Row| scaled(axis(r.direction), r.force);
    let most = habit.rows.iter().fold(0.0_f64, |m, r| m.max(r.force.abs()));
    let mains = ["A1", "A2", "A3"];
    let site = *pick(random, &mains);
    let drive = arm
        .springs
        .iter()
        .find(|s| s.effect == "drive_stiffness" && s.site == site);
    let drive = drive.unwrap().clone();
    let j = site.as_bytes()[1] as usize - b'1' as usize;
    match name {
        "flange slides on a spring" => {
            let v = [1.0, 0.0, 0.0];
            let v = if chance(random, 0.5) { v } else { w };
            let of = |r: &Row| {
                let v = flange(r, v);
                scaled(v, dot(&v, &load(r)))
            };
            (habit.rows.iter().map(of).collect(), "along one line".into())
        }
        "foot slides on a spring" => {
            let level = chance(random, 0.5);
            let of = |r: &Row| {
                let f = load(r);
                match level {
                    true => minus(f, scaled(arm.ground[2], dot(&arm.ground[2], &f))),
                    false => scaled(arm.ground[2], dot(&arm.ground[2], &f)),
                }
            };
            let law = if level { "level" } else { "upright" };
            (habit.rows.iter().map(of).collect(), law.into())
        }
        "play at the tool" => {
            let near = random.uniform(0.02, 0.1) * most;
            let of = |r: &Row| {
                let v = flange(r, w);
                scaled(v, (dot(&v, &load(r)) / near).clamp(-1.0, 1.0))
            };
            (habit.rows.iter().map(of).collect(), String::new())
        }
        "stiffness with the angle" => {
            let waves = random.uniform(2.0, 6.0);
            let phase = random.uniform(0.0, TAU);
            let of = |i: usize, m: f64| {
                let q = habit.stated(habit.rows[i].point)[j];
                m * (waves * q + phase).cos()
            };
            (
                habit.by_line(&drive, of),
                format!("{site} {waves:.1} waves a turn"),
            )
        }
        "base bolt slips" => {
            let [a, _] = across(arm.ground[2]);
            let hinge = Spring {
                axis: a,
                ..arm.soft_base(1.0, 1.0, [0.0; 3])[0].clone()
            };
            let m = moments(habit, &hinge);
            let width = random.uniform(0.15, 0.5) * m.iter().fold(0.0_f64, |x, y| x.max(y.abs()));
            let at = play(habit, &m, width);
            (habit.by_line(&hinge, |i, _| at[i]), String::new())
        }
        "laser stand rubs" => {
            // The reading stays behind until the stand lets go.
            let told = habit.readings(&World::told(habit), false);
            let width = random.uniform(0.05, 0.3);
            let peak = |k: usize| told.iter().fold(0.0_f64, |m, d| m.max(d[k].abs()));
            let part = |k: usize| {
                let u: Vec<f64> = told.iter().map(|d| d[k]).collect();
                let at = play(habit, &u, width * peak(k));
                at.iter().zip(&u).map(|(a, u)| a - u).collect::<Vec<f64>>()
            };
            let all = [part(0), part(1), part(2)];
            let of = |i: usize| std::array::from_fn(|k| all[k][i]);
            (
                (0..habit.rows.len()).map(of).collect(),
                format!("{width:.2} of the way"),
            )
        }
        "joint creeps" => {
            let m = moments(habit, &drive);
            let slow = random.uniform(2.0, 12.0);
            let (mut at, mut series) = (0.0, usize::MAX);
            let mut lag = Vec::new();
            for (r, m) in habit.rows.iter().zip(&m) {
                let now = r.setup * 8 + r.cycle;
                if now != series {
                    (at, series) = (0.0, now);
                }
                at += (m - at) * (1.0 - (-1.0 / slow).exp());
                lag.push(at);
            }
            (
                habit.by_line(&drive, |i, _| lag[i]),
                format!("{site} within {slow:.0} steps"),
            )
        }
        _ => {
            let m = moments(habit, &drive);
            let peak = m.iter().fold(1e-9_f64, |x, y| x.max(y.abs()));
            (
                habit.by_line(&drive, |i, _| -peak * (m[i] / peak).powi(3)),
                site.into(),
            )
        }
    }
}

impl Habit {
    fn rivals(&self, base: &[V3]) -> Vec<Rival> {
        let arm = &self.arm;
        let mut all: Vec<Rival> = Vec::new();
        let mut springs: Vec<Vec<Spring>> = Vec::new();
        for s in arm.springs.iter().filter(|s| s.effect != "base_compliance") {
            match springs
                .iter_mut()
                .find(|g| g[0].effect == s.effect && g[0].site == s.site)
            {
                Some(own) => own.push(s.clone()),
                None => springs.push(vec![s.clone()]),
            }
        }
        for group in springs {
            let mut sum = vec![[0.0; 3]; self.rows.len()];
            for s in &group {
                sum = sum
                    .iter()
                    .zip(self.soft(s))
                    .map(|(a, b)| plus(*a, b))
                    .collect();
            }
            all.push((group[0].effect, Some(group[0].site.clone()), vec![sum]));
        }
        let each = |springs: Vec<Spring>| -> Rival {
            let columns = springs.iter().map(|s| self.soft(s)).collect();
            (springs[0].effect, Some(springs[0].site.clone()), columns)
        };
        for j in 0..6 {
            if arm
                .stiffness("tilt_stiffness", &format!("A{}", j + 1))
                .is_none()
            {
                let pair = each(arm.bearing(j, 1e6));
                let sum = pair.2[0].iter().zip(&pair.2[1]).map(|(a, b)| plus(*a, *b));
                all.push((pair.0, pair.1, vec![sum.collect()]));
            }
        }
        if !arm.springs.iter().any(|s| s.effect == "base_compliance") {
            all.push(each(arm.soft_base(1e6, 1.0, [0.0; 3])));
        }
        for link in 1..=3 {
            all.push(each(arm.bend(link, 1e6, false, true)));
        }
        all.push(each(arm.soft_tool(1e5, 1.0)));
        all.push((
            "force_gain",
            None,
            vec![base.iter().map(|d| scaled(*d, 0.01)).collect()],
        ));
        for k in 0..3 {
            let one = base.iter().map(|d| scaled(axis(k), 0.01 * d[k])).collect();
            all.push((
                "sensor_gain",
                Some(format!("sensor-{}", ["x", "y", "z"][k])),
                vec![one],
            ));
        }
        all.extend(
            self.misaligned()
                .map(|columns| ("load_misalignment", None, columns)),
        );
        for p in 0..self.joints_deg.len() {
            all.push((
                "outlier_point",
                Some(format!("point{}", p + 1)),
                self.own_compliance(p),
            ));
        }
        for j in 0..6 {
            let site = format!("A{}", j + 1);
            let drive = arm
                .springs
                .iter()
                .find(|s| s.effect == "drive_stiffness" && s.site == site);
            let free = lost_motion(self, drive.unwrap(), j, false, 0.03);
            all.push(("backlash", Some(site), vec![free]));
        }
        all
    }

    /// Loads askew in the base frame, in that of the hand, or for one direction.
    fn misaligned(&self) -> [Vec<Vec<V3>>; 5] {
        let gives: Vec<[V3; 3]> = (0..self.joints_deg.len()).map(|p| self.gives(p)).collect();
        let column = |whose: usize, about: V3| -> Vec<V3> {
            let of = |r: &Row| {
                let about = match whose {
                    0 => about,
                    1 => facing(&self.arm.frame, &self.stated(r.point), 6, about),
                    own if own - 2 == r.direction => about,
                    _ => [0.0; 3],
                };
                let more = cross(about, scaled(axis(r.direction), 1e-3 * r.force));
                let c = &gives[r.point];
                (0..3).fold([0.0; 3], |d, k| plus(d, scaled(c[k], more[k])))
            };
            self.rows.iter().map(of).collect()
        };
        std::array::from_fn(|whose| (0..3).map(|k| column(whose, axis(k))).collect())
    }

    /// What the hand does at a point under one newton along x, y, z.
    fn gives(&self, point: usize) -> [V3; 3] {
        let q = self.stated(point);
        let lines = self
            .arm
            .springs
            .iter()
            .map(|s| (self.arm.line(s, &q), s.stiffness));
        let lines: Vec<(Line, f64)> = lines.collect();
        let hand = self.arm.hand(&q);
        [0, 1, 2].map(|k| scaled(deflected(&lines, hand, hand, scaled(axis(k), 100.0)), 0.01))
    }

    /// Any compliance of a point of its own, direction by direction.
    fn own_compliance(&self, point: usize) -> Vec<Vec<V3>> {
        let mut all = Vec::new();
        for direction in 0..3 {
            for k in 0..3 {
                let of = |r: &Row| match r.point == point && r.direction == direction {
                    true => scaled(axis(k), 1e-8 * r.force),
                    false => [0.0; 3],
                };
                all.push(self.rows.iter().map(of).collect());
            }
        }
        all
    }

    /// The stated springs a little softer, with what is known of them beforehand.
    fn free(&self, sieve: &Sieve) -> Vec<Vec<f64>> {
        let near = self.told_near.unwrap_or(UNTOLD);
        let mut groups: Vec<(String, Vec<V3>)> = Vec::new();
        for s in &self.arm.springs {
            let tag = format!("{} {}", s.effect, s.site);
            let column = self.soft(s);
            match groups.iter_mut().find(|g| g.0 == tag) {
                Some(own) => own
                    .1
                    .iter_mut()
                    .zip(column)
                    .for_each(|(a, b)| *a = plus(*a, b)),
                None => groups.push((tag, column)),
            }
        }
        let count = groups.len();
        let of = |(i, g): (usize, &(String, Vec<V3>))| {
            let mut tail = vec![0.0; count];
            tail[i] = 1.0 / near;
            sieve.of(&g.1, &tail)
        };
        groups.iter().enumerate().map(of).collect()
    }
}

/// A hidden thing: its name, site, law and what it does.
type Hidden = (&'static str, Option<String>, String, Vec<V3>);

fn hide(habit: &Habit, world: &mut World, random: &mut Random) -> Vec<Hidden> {
    let names = chosen(random, USUAL, [&EFFECTS, &OUTSIDE], |name| {
        fits(name, habit)
    });
    let mut all = Vec::new();
    for name in names {
        if EFFECTS.contains(&name) {
            let before = world.clone();
            let (site, law) = place(name, habit, world, random);
            all.push((name, site, law, habit.difference(world, &before)));
        } else {
            let (unit, law) = outside(name, habit, random);
            let peak = unit.iter().flatten().fold(1e-30_f64, |m, x| m.max(x.abs()));
            let size = random.log_uniform(4.0, 40.0) * habit.noise;
            let change: Vec<V3> = unit.iter().map(|u| scaled(*u, size / peak)).collect();
            for (e, c) in world.extra.iter_mut().zip(&change) {
                *e = plus(*e, *c);
            }
            let law = format!("{name}; {law} {:.0} um", 1e6 * size);
            all.push(("outside", None, law, change));
        }
    }
    all
}

fn truths(habit: &Habit, hidden: &[Hidden]) -> Vec<Truth> {
    if hidden.is_empty() {
        return Vec::new();
    }
    let base = habit.readings(&World::told(habit), false);
    let sieve = Sieve::new(habit, &base);
    let free = habit.free(&sieve);
    let tail = vec![0.0; free.len()];
    let rivals: Vec<Seen> = habit
        .rivals(&base)
        .into_iter()
        .map(|(e, s, c)| (e, s, c.iter().map(|c| sieve.of(c, &tail)).collect()))
        .collect();
    let seen: Vec<Vec<f64>> = hidden.iter().map(|h| sieve.of(&h.3, &tail)).collect();
    (0..hidden.len())
        .map(|i| {
            let others = seen.iter().enumerate().filter(|(j, _)| *j != i);
            let known: Vec<Vec<f64>> = free
                .iter()
                .cloned()
                .chain(others.map(|o| o.1.clone()))
                .collect();
            truth(habit, hidden, i, &basis(&known), &seen[i], &rivals)
        })
        .collect()
}

fn truth(
    habit: &Habit,
    hidden: &[Hidden],
    i: usize,
    known: &[Vec<f64>],
    seen: &[f64],
    rivals: &[Seen],
) -> Truth {
    let (name, site, law, change) = &hidden[i];
    let own = without(seen, known);
    let sight = dot(&own, &own).sqrt();
    let left = |columns: &Vec<Vec<f64>>| {
        let bare: Vec<Vec<f64>> = columns.iter().map(|c| without(c, known)).collect();
        let rest = without(&own, &basis(&bare));
        dot(&rest, &rest).sqrt()
    };
    let is_hidden = |e: &str, s: &Option<String>| {
        hidden
            .iter()
            .any(|h| h.0 == e && (h.1.is_none() || h.1 == *s))
    };
    let near: Vec<(&'static str, Option<String>, f64)> = rivals
        .iter()
        .filter(|(e, s, _)| !is_hidden(e, s))
        .map(|(e, s, c)| (*e, s.clone(), left(c)))
        .collect();
    let inside = *name != "outside";
    let twins = near.iter().filter(|n| inside && twin(n.2, sight));
    let most = change.iter().flatten().fold(0.0_f64, |m, x| m.max(x.abs()));
    Truth {
        effect: name,
        site: site.clone(),
        sight,
        apart: near.iter().map(|n| n.2).fold(sight, f64::min),
        twins: twins.map(|n| (n.0, n.1.clone())).collect(),
        strength: most / habit.noise,
        law: law.clone(),
    }
}

/// The robot as it is: every spring off by what nobody needs to name.
fn real(habit: &Habit, random: &mut Random) -> World {
    let mut world = World::told(habit);
    let mut last = (String::new(), 1.0);
    for s in &mut world.springs {
        let tag = format!("{} {}", s.effect, s.site);
        if last.0 != tag {
            last = (tag, 1.0 + habit.near * random.normal().clamp(-2.0, 2.0));
        }
        s.stiffness /= last.1;
    }
    world
}

/// A case.
pub fn draw(seed: u64) -> Case {
    let mut random = Random::new(seed ^ 0x30_b5ce);
    let habit = Habit::draw(&mut random);
    let mut world = real(&habit, &mut random);
    let hidden = hide(&habit, &mut world, &mut random);
    let truths = truths(&habit, &hidden);
    let rows = habit.readings(&world, true);
    let files = vec![
        ("points.csv".to_string(), text(&habit, &rows, &mut random)),
        ("robot.toml".to_string(), habit.arm.text.clone()),
    ];
    Case {
        seed,
        truths,
        habit: habit.said(),
        files,
    }
}

impl Habit {
    fn said(&self) -> String {
        let per = self.rows.len() / self.setups.len().max(1);
        let mut said = format!(
            "{}, {} points, {} set-ups of {per} rows, read {}, noise {:.1} um",
            self.arm.build,
            self.joints_deg.len(),
            self.setups.len(),
            self.read,
            1e6 * self.noise
        );
        let mut more = |when: bool, what: String| {
            if when {
                said += &what;
            }
        };
        more(self.growth > 0.0, format!(" growing {:.1}", self.growth));
        more(
            self.drift > 0.0,
            format!(", drift {:.1} um", 1e6 * self.drift),
        );
        more(self.tared, ", tared".into());
        more(self.cell > 0.0, format!(", cell {} N", self.cell));
        let told = |x: Option<f64>| x.map_or("untold".into(), |x| format!("{x}"));
        more(true, format!(", springs {}", told(self.told_near)));
        more(
            true,
            format!(", repeats {} ({:.4})", told(self.told_repeat), self.repeat),
        );
        more(
            self.askew > 0.0,
            format!(", set-ups askew {:.1} mrad", 1e3 * self.askew),
        );
        more(
            self.target != self.arm.frame.tcp,
            ", target off the tip".into(),
        );
        said
    }

    fn head(&self) -> String {
        let row = |q: &[f64; 6]| {
            let all: Vec<String> = q.iter().map(|d| format!("{:?}", d + 0.0)).collect();
            format!("#   [{}],\n", all.join(", "))
        };
        let rows: Vec<String> = self.joints_deg.iter().map(row).collect();
        let mut head = format!(
            "# kind = \"workspace\"\n# robot = \"robot.toml\"\n# joint_angles_deg = [\n{}# ]\n",
            rows.concat()
        );
        if let Some(near) = self.told_near {
            head += &format!("# nominal_stiffness_rel_std = {near}\n");
        }
        if let Some(repeat) = self.told_repeat {
            head += &format!("# setup_repeatability = {repeat}\n");
        }
        if self.told_noise {
            head += &format!("# sensor_noise_mm = {:.5}\n", 1e3 * self.noise);
        }
        let titles = [
            "point",
            "direction",
            "cycle",
            "force_N",
            "dx_mm",
            "dy_mm",
            "dz_mm",
        ];
        head + &titles.join(if self.german { ";" } else { "," }) + "\n"
    }
}

fn text(habit: &Habit, rows: &[V3], random: &mut Random) -> String {
    let most = habit.rows.iter().fold(0.0_f64, |m, r| m.max(r.force.abs()));
    let mut all = habit.head();
    let mut series = usize::MAX;
    let (mut zero, mut slope, mut bow) = ([0.0; 3], [0.0; 3], 0.0);
    let count = habit
        .rows
        .iter()
        .filter(|r| r.setup == 0 && r.cycle == 0)
        .count();
    for (r, d) in habit.rows.iter().zip(rows) {
        let noise = habit.noise * (1.0 + habit.growth * r.force.abs() / most);
        let first = r.setup * 8 + r.cycle != series;
        if first {
            series = r.setup * 8 + r.cycle;
            zero = [0.0; 3];
            slope = std::array::from_fn(|_| habit.drift * random.normal());
            bow = random.uniform(-1.0, 1.0);
        }
        let t = r.step / count as f64;
        let room = scaled(slope, t * (1.0 + bow * (1.0 - t)));
        let read: V3 = std::array::from_fn(|k| d[k] + room[k] + noise * random.normal());
        if first && habit.tared {
            zero = read;
        }
        let cell = |k: usize, random: &mut Random| {
            let lost = habit.gaps && chance(random, 0.01);
            if lost || !habit.is_read(r, k) {
                return String::new();
            }
            let value = ((read[k] - zero[k]) / habit.rounding).round() * habit.rounding;
            format!("{:.6}", 1e3 * value)
        };
        let cells = [
            (r.point + 1).to_string(),
            ["x", "y", "z"][r.direction].to_string(),
            (r.cycle + 1).to_string(),
            format!("{:?}", r.told),
            cell(0, random),
            cell(1, random),
            cell(2, random),
        ];
        let line = match habit.german {
            true => cells.join(";").replace('.', ","),
            false => cells.join(","),
        };
        all += &line;
        all.push('\n');
    }
    all
}

/// How far naming what is hidden lowers the error of the present simulation, in percent of the whole file as read:
/// with every other spring as the file states it, and with every other spring as it is.
pub fn worth(seed: u64) -> [f64; 2] {
    let mut random = Random::new(seed ^ 0x30_b5ce);
    let habit = Habit::draw(&mut random);
    let (mut world, told) = (real(&habit, &mut random), World::told(&habit));
    let hidden = hide(&habit, &mut world, &mut random);
    let rows = habit.readings(&world, true);
    let (present, best) = (habit.readings(&told, false), habit.readings(&world, false));
    let (mut before, mut after) = (0.0, [0.0; 2]);
    for (i, r) in habit.rows.iter().enumerate() {
        for k in (0..3).filter(|k| habit.is_read(r, *k)) {
            let read = rows[i][k] + habit.noise * random.normal();
            let named: f64 = hidden.iter().map(|h| h.3[i][k]).sum();
            before += (read - present[i][k]).powi(2);
            after[0] += (read - present[i][k] - named).powi(2);
            after[1] += (read - best[i][k]).powi(2);
        }
    }
    after.map(|after| 100.0 * (1.0 - (after / before).sqrt()))
}
