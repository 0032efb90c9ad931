//! Records of hits: what the tool does, what the channels say of it, and the file.

use super::super::algebra::{V3, cross, norm, plus, scaled};
use super::dynamics::{C, Pairs, Plant, World};
use super::habit::{Habit, Hit, Noise};
use super::robot::Spread;
use ident::ground::random::Random;
use nalgebra::DMatrix;
use std::f64::consts::{PI, TAU};

/// A record: force along the hit, acceleration of the tool; without noise.
pub struct Record {
    pub direction: usize,
    pub number: usize,
    pub force: Vec<f64>,
    pub acceleration: [Vec<f64>; 3],
}

/// Low pass of both channels: Butterworth, fourth order, two sections of the bilinear kind.
struct LowPass {
    sections: [[f64; 5]; 2],
    state: [[f64; 2]; 2],
}

impl LowPass {
    fn new(cycles_per_step: f64) -> Self {
        let k = (PI * cycles_per_step).tan();
        let section = |angle: f64| {
            let damped = 2.0 * angle.cos() * k;
            let all = 1.0 + damped + k * k;
            let b = k * k / all;
            let a = [2.0 * (k * k - 1.0) / all, (1.0 - damped + k * k) / all];
            [b, 2.0 * b, b, a[0], a[1]]
        };
        Self {
            sections: [section(PI / 8.0), section(3.0 * PI / 8.0)],
            state: [[0.0; 2]; 2],
        }
    }

    fn of(&mut self, x: f64) -> f64 {
        let mut x = x;
        for ([b0, b1, b2, a1, a2], [s1, s2]) in self.sections.iter().zip(&mut self.state) {
            let y = b0 * x + *s1;
            *s1 = b1 * x - a1 * y + *s2;
            *s2 = b2 * x - a2 * y;
            x = y;
        }
        x
    }
}

fn filtered(habit: &Habit, fine: &[f64]) -> Vec<f64> {
    let mut pass = LowPass::new(0.28 / habit.fine as f64);
    let all: Vec<f64> = fine.iter().map(|x| pass.of(*x)).collect();
    all.into_iter()
        .step_by(habit.fine)
        .take(habit.samples)
        .collect()
}

/// A second pulse where the world has one.
fn forces(world: &World, habit: &Habit, hit: &Hit) -> Vec<f64> {
    let mut all = vec![0.0; habit.samples * habit.fine + 2];
    let mut add = |from: usize, share: f64| {
        for (i, f) in hit.pulse.iter().enumerate() {
            if let Some(x) = all.get_mut(from + i) {
                *x += share * f;
            }
        }
    };
    add(hit.start, 1.0);
    for (direction, number, share, after) in &world.second {
        if (*direction, *number) == (hit.direction, hit.number) {
            add(hit.start + (after / habit.step()) as usize, *share);
        }
    }
    all
}

/// Acceleration of the tool per unit force at one instant, along each direction; linear worlds only.
fn answers(plant: &Plant, habit: &Habit) -> Vec<Vec<V3>> {
    let count = habit.samples * habit.fine + 1;
    let one = |d: usize| {
        let force = move |k: usize| std::array::from_fn(|i| f64::from(u8::from(i == d && k == 1)));
        plant.run(&plant.hand, &force, habit.step(), count + 1, None)[1..].to_vec()
    };
    (0..3).map(one).collect()
}

fn folded(answer: &[V3], force: &[f64]) -> Vec<V3> {
    let mut all = vec![[0.0; 3]; answer.len()];
    for (from, f) in force.iter().enumerate().filter(|(_, f)| **f != 0.0) {
        for (to, a) in all.iter_mut().skip(from).zip(answer) {
            (0..3).for_each(|i| to[i] += f * a[i]);
        }
    }
    all
}

/// A hit that only steps through time can tell: elsewhere than aimed, answered by a cable, or on a bent spring.
fn stepped(world: &World, plant: &Plant, habit: &Habit, hit: &Hit, force: &[f64]) -> Vec<V3> {
    let aim = habit.hits.iter().find(|h| h.direction == hit.direction);
    let aside = aim.map_or(hit.place, |h| h.place);
    let lever = scaled(plus(aside, scaled(hit.place, 0.15)), world.wander);
    let n = plant.m.nrows();
    let mut at = plant.hand.clone();
    let lines = super::dynamics::lines(&world.robot, &world.joints);
    for (i, (axis, _)) in lines.iter().enumerate().take(n) {
        let more = cross(*axis, lever);
        (0..3).for_each(|r| at[(r, i)] += more[r]);
    }
    let when = hit.start + (hit.back.0 / habit.step()) as usize;
    let back = scaled(hit.back.1, world.knock / norm(hit.back.1));
    let along = |k: usize| -> V3 {
        let f = force.get(k).copied().unwrap_or(0.0);
        let knock = k
            .checked_sub(when)
            .and_then(|i| hit.pulse.get(i))
            .copied()
            .unwrap_or(0.0);
        std::array::from_fn(|i| knock * back[i] + if i == hit.direction { f } else { 0.0 })
    };
    plant.run(
        &at,
        &along,
        habit.step(),
        habit.samples * habit.fine + 1,
        world.bent,
    )
}

/// Later by `delay`, a straight line between fine steps.
fn late(fine: &[f64], steps: f64) -> Vec<f64> {
    let at = |k: usize| {
        let x = k as f64 - steps;
        if x < 0.0 {
            return fine[0];
        }
        let (i, rest) = (x as usize, x.fract());
        let next = fine[(i + 1).min(fine.len() - 1)];
        fine[i.min(fine.len() - 1)] * (1.0 - rest) + next * rest
    };
    (0..fine.len()).map(at).collect()
}

/// All records of a day.
pub fn records(world: &World, habit: &Habit) -> Vec<Record> {
    let plant = world.plant();
    let plain = world.bent.is_none() && world.wander == 0.0 && world.knock == 0.0;
    let answers = if plain {
        answers(&plant, habit)
    } else {
        Vec::new()
    };
    let one = |hit: &Hit| {
        let force = forces(world, habit, hit);
        let moved = match plain {
            true => folded(&answers[hit.direction], &force),
            false => stepped(world, &plant, habit, hit, &force),
        };
        let read = |r: usize| {
            let sensor = world.sensor[r];
            let fine: Vec<f64> = moved
                .iter()
                .map(|a| (0..3).map(|k| sensor[k] * a[k]).sum())
                .collect();
            filtered(habit, &late(&fine, world.delay / habit.step()))
        };
        let hammer: Vec<f64> = force.iter().map(|f| f * world.hammer).collect();
        let mut own = Record {
            direction: hit.direction,
            number: hit.number,
            force: filtered(habit, &hammer),
            acceleration: [read(0), read(1), read(2)],
        };
        own.window(world.decay, habit.interval);
        own
    };
    habit.hits.iter().map(one).collect()
}

impl Record {
    fn window(&mut self, decay: f64, interval: f64) {
        let [x, y, z] = &mut self.acceleration;
        for channel in [&mut self.force, x, y, z] {
            for (i, v) in channel.iter_mut().enumerate() {
                *v *= (-decay * i as f64 * interval).exp();
            }
        }
    }

    /// Spectra at a frequency: force and accelerations.
    fn spectrum(&self, turn: f64) -> (C, [C; 3]) {
        let (step, mut now) = (C::from_polar(1.0, -turn), C::new(1.0, 0.0));
        let (mut f, mut a) = (C::new(0.0, 0.0), [C::new(0.0, 0.0); 3]);
        for i in 0..self.force.len() {
            f += now * self.force[i];
            (0..3).for_each(|r| a[r] += now * self.acceleration[r][i]);
            now *= step;
        }
        (f, a)
    }
}

/// Transfer functions of records (H1), and the sum of |F|² of every direction.
pub fn estimated(records: &[Record], frequency: f64, interval: f64) -> (Pairs, [f64; 3]) {
    let (mut cross, mut own) = ([[C::new(0.0, 0.0); 3]; 3], [0.0; 3]);
    for record in records {
        let (f, a) = record.spectrum(TAU * frequency * interval);
        own[record.direction] += f.norm_sqr();
        (0..3).for_each(|r| cross[r][record.direction] += a[r] * f.conj());
    }
    let h = |r: usize, d: usize| cross[r][d] / own[d].max(1e-300);
    let pairs = std::array::from_fn(|r| std::array::from_fn(|d| h(r, d)));
    (pairs, own)
}

/// What the channels scatter, added before windows and converters.
fn read(clean: &[f64], noise: &Noise, interval: f64, decay: f64, random: &mut Random) -> Vec<f64> {
    let pole = (-TAU * noise.corner * interval).exp();
    let grain = noise.slow * noise.white * (1.0 - pole * pole).sqrt();
    let (mut slow, phase) = (
        noise.slow * noise.white * random.normal(),
        random.uniform(0.0, TAU),
    );
    let mut one = |(i, v): (usize, &f64)| {
        let time = i as f64 * interval;
        slow = pole * slow + grain * random.normal();
        let hum = noise.hum * (TAU * 50.0 * time + phase).sin();
        let window = (-decay * time).exp();
        let scatter = noise.white * random.normal() + slow + hum;
        ((v + window * scatter) / noise.step).round() * noise.step
    };
    clean.iter().enumerate().map(&mut one).collect()
}

/// Facts of the file beside robot and posture.
pub fn facts(habit: &Habit, spread: &Spread, told: [bool; 3], window: Option<f64>) -> String {
    let mut all = String::new();
    let mut fact = |key: &str, value: f64| all += &format!("# {key} = {value:?}\n");
    if habit.told_noise {
        fact("accelerometer_noise_m_s2", habit.noise.white);
    }
    if let Some(window) = window {
        fact("exponential_window_s", window);
    }
    if told[0] {
        fact("mass_rel_std", spread.mass);
        fact("com_std_m", spread.com);
        fact("inertia_rel_std", spread.inertia);
    }
    if told[1] {
        fact("damping_rel_std", spread.damping);
    }
    if told[2] {
        fact("nominal_stiffness_rel_std", spread.stiffness);
        fact("gain_rel_std", spread.gain);
    }
    all
}

/// Rows of the file.
pub fn rows(records: &[Record], habit: &Habit, decay: f64, random: &mut Random) -> String {
    let names = ["x", "y", "z"];
    let mut text = String::from("direction,hit,time_s,force_N");
    let read_ones = names.iter().enumerate();
    for (_, name) in read_ones.filter(|(r, _)| habit.responses.contains(r)) {
        text += &format!(",a{name}_m_s2");
    }
    text.push('\n');
    let hammer = Noise {
        white: habit.noise.force,
        slow: 0.0,
        hum: 0.0,
        step: habit.noise.force_step,
        ..habit.noise
    };
    for record in records {
        let force = read(&record.force, &hammer, habit.interval, decay, random);
        let channel = |r: usize| &record.acceleration[r];
        let all: Vec<Option<Vec<f64>>> = (0..3)
            .map(|r| {
                let told = habit.responses.contains(&r);
                told.then(|| read(channel(r), &habit.noise, habit.interval, decay, random))
            })
            .collect();
        for i in 0..habit.samples {
            let time = i as f64 * habit.interval;
            text += &format!(
                "{},{},{time:.7},{:.2}",
                names[record.direction], record.number, force[i]
            );
            for a in all.iter().flatten() {
                text += &format!(",{:.4}", a[i]);
            }
            text.push('\n');
        }
    }
    text
}

/// Unit matrix turned by a small or large vector of turn.
pub fn askew(turn: V3) -> [[f64; 3]; 3] {
    let [x, y, z] = turn;
    let skew = DMatrix::from_row_slice(3, 3, &[0.0, -z, y, z, 0.0, -x, -y, x, 0.0]);
    let turned = skew.exp();
    std::array::from_fn(|i| std::array::from_fn(|j| turned[(i, j)]))
}
