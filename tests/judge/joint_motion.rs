//! Joints with an encoder on either side of the gear, as laboratories move them: a motor that follows a programme, a
//! link behind a spring, a motor torque that pays for weight, inertia, neighbours and friction.

mod causes;
mod programme;

use super::algebra::length_beyond;
use super::chosen::chosen;
use super::{Case, Truth, chance, pick, twin};
use causes::{EFFECTS, OUTSIDE, Shown, rivals, shown};
use ident::ground::random::Random;
use programme::Programme;
use std::f64::consts::TAU;

/// One joint as it is, and what its instruments are worth.
struct Joint {
    number: usize,
    programme: Programme,
    /// True stiffness, N·m/rad.
    stiffness: f64,
    /// What the file says of it, and how well that is known.
    stated: Option<(f64, f64)>,
    ratio: f64,
    /// Torque in the gear, N·m.
    torque: Vec<f64>,
    /// Inertia of the motor on the link's side, kg·m².
    rotor: f64,
    /// Scatter of the link encoder, rad, and the steps in which it counts.
    noise: f64,
    step: f64,
    /// Scatter of the motor's torque as a share of its range, and how often it swings per turn of the motor.
    torque_noise: f64,
    hum: f64,
    slow: f64,
    zero: f64,
}

impl Joint {
    fn draw(random: &mut Random, number: usize, seconds: f64, cycle: f64) -> Self {
        let programme = Programme::draw(random, seconds, cycle);
        let neighbour = Programme::draw(random, seconds, cycle);
        let (inertia, lever) = (random.uniform(60.0, 450.0), random.uniform(0.0, TAU));
        let weight = random.log_uniform(400.0, 6000.0);
        let pull = weight * random.uniform(0.0, 0.3);
        let shake = inertia * random.uniform(0.0, 0.4);
        let torque = |i: usize| {
            weight * (programme.angle[i] + lever).cos()
                + inertia * programme.acceleration[i]
                + pull * (neighbour.angle[i] + programme.angle[i]).sin()
                + shake * neighbour.acceleration[i]
        };
        let torque: Vec<f64> = (0..programme.time.len()).map(torque).collect();
        let stiffness = random.log_uniform(1.0e6, 8.0e6);
        let known = random.uniform(0.03, 0.15);
        let noise = random.log_uniform(1.5e-6, 1.2e-5);
        Self {
            number,
            stiffness,
            stated: chance(random, 0.6).then(|| {
                let off = known * random.normal().clamp(-1.5, 1.5);
                (stiffness / (1.0 + off), known)
            }),
            ratio: random.uniform(90.0, 280.0).round(),
            torque,
            rotor: random.uniform(20.0, 200.0),
            noise,
            step: *pick(random, &[1e-7, 5e-7, 2e-6, 5e-6]),
            torque_noise: random.log_uniform(0.001, 0.01),
            hum: if chance(random, 0.15) { noise } else { 0.0 },
            slow: if chance(random, 0.2) {
                0.5 * noise
            } else {
                0.0
            },
            zero: random.normal() * 1e-3,
            programme,
        }
    }

    /// Scatter of a reading, rad.
    fn spread(&self) -> f64 {
        let torque = self.torque_noise * span(&self.torque) / self.stiffness;
        (self.noise.powi(2) + self.step.powi(2) / 12.0 + torque.powi(2)).sqrt()
    }

    /// What the motor pays beside friction, N·m.
    fn paid(&self) -> Vec<f64> {
        let each = self.torque.iter().zip(&self.programme.acceleration);
        each.map(|(t, a)| t + self.rotor * a).collect()
    }

    /// What any account of a sound joint may do: a zero, a spring, the inertia of the motor.
    fn sound(&self) -> Vec<Vec<f64>> {
        vec![
            vec![1.0; self.torque.len()],
            self.torque.clone(),
            self.programme.acceleration.clone(),
        ]
    }
}

/// Largest less least.
fn span(v: &[f64]) -> f64 {
    let most = v.iter().copied().fold(f64::MIN, f64::max);
    most - v.iter().copied().fold(f64::MAX, f64::min)
}

/// How a cause is seen: against all that is sound, all else that is hidden, and each rival.
fn truth(joint: &Joint, (name, own): (&'static str, &Shown), others: &[Vec<f64>]) -> Truth {
    let spread = joint.spread();
    let mut known = joint.sound();
    if name == "stiffness" {
        known.remove(1);
    }
    known.extend(others.iter().cloned());
    let sight = length_beyond(&own.seen, &known) / spread;
    let beside = |columns: &Vec<Vec<f64>>| {
        let all: Vec<Vec<f64>> = known.iter().chain(columns).cloned().collect();
        length_beyond(&own.seen, &all) / spread
    };
    let rivals = rivals(joint);
    let others: Vec<_> = rivals.iter().filter(|(n, _)| *n != name).collect();
    let inside = EFFECTS.contains(&name);
    let near = others
        .iter()
        .filter(|(_, c)| inside && twin(beside(c), sight));
    let mut twins: Vec<(&'static str, Option<String>)> = near.map(|(n, _)| (*n, None)).collect();
    twins.dedup();
    Truth {
        effect: if inside { name } else { "outside" },
        site: (inside && name != "time_skew").then(|| format!("A{}", joint.number)),
        sight,
        apart: others.iter().map(|(_, c)| beside(c)).fold(sight, f64::min),
        twins,
        strength: own.seen.iter().fold(0.0, |m: f64, v| m.max(v.abs())) / spread,
        law: own.law.clone(),
    }
}

/// Columns of a joint: motor and link angle, motor torque, speed.
fn columns(joint: &Joint, all: &[Shown], random: &mut Random) -> [Vec<f64>; 4] {
    let rows = joint.torque.len();
    let motor = joint.programme.angle.clone();
    let mut paid = joint.paid();
    let mut link: Vec<f64> = (0..rows)
        .map(|i| motor[i] - joint.torque[i] / joint.stiffness + joint.zero)
        .collect();
    for shown in all {
        paid.iter_mut()
            .zip(&shown.torque)
            .for_each(|(p, t)| *p += t);
        link.iter_mut().zip(&shown.link).for_each(|(l, s)| *l += s);
    }
    let (width, mut slow, phase) = (span(&paid), 0.0, random.uniform(0.0, TAU));
    for i in 0..rows {
        slow = 0.995 * slow + 0.1 * joint.slow * random.normal();
        let mains = joint.hum * (314.159_265 * joint.programme.time[i] + phase).sin();
        let read = link[i] + slow + mains + joint.noise * random.normal();
        link[i] = (read / joint.step).round() * joint.step;
        paid[i] += joint.torque_noise * width * random.normal();
    }
    let speed = joint.programme.speed.clone();
    [motor, link, paid, speed]
}

/// A file of joints.
fn text(joints: &[Joint], shown: &[Vec<Shown>], random: &mut Random) -> String {
    let list = |of: &dyn Fn(&Joint) -> f64| {
        let all: Vec<String> = joints.iter().map(|j| format!("{}", of(j))).collect();
        all.join(", ")
    };
    let mut text = format!(
        "# kind = \"joint-motion\"\n# synthetic = true\n# gear_ratio = [{}]\n",
        list(&|j| j.ratio)
    );
    if joints.iter().all(|j| j.stated.is_some()) {
        let stated = |j: &Joint| j.stated.unwrap_or_default();
        text += &format!(
            "# nominal_stiffness_Nm_rad = [{}]\n",
            list(&|j| stated(j).0)
        );
        text += &format!(
            "# nominal_stiffness_rel_std = [{}]\n",
            list(&|j| stated(j).1)
        );
    }
    text += "time_s";
    for j in joints {
        let n = j.number;
        text += &format!(
            ",motor_angle_deg_{n},link_angle_deg_{n},motor_torque_Nm_{n},motor_speed_deg_s_{n}"
        );
    }
    text.push('\n');
    let all: Vec<[Vec<f64>; 4]> = joints
        .iter()
        .zip(shown)
        .map(|(j, s)| columns(j, s, random))
        .collect();
    for (i, time) in joints[0].programme.time.iter().enumerate() {
        text += &format!("{time:.4}");
        for (joint, [motor, link, paid, speed]) in joints.iter().zip(&all) {
            let (m, l) = (motor[i].to_degrees(), link[i].to_degrees());
            let (t, v) = (paid[i] / joint.ratio, speed[i].to_degrees());
            text += &format!(",{m:.7},{l:.7},{t:.5},{v:.5}");
        }
        text.push('\n');
    }
    text
}

/// What the causes of a joint show, sized so that the best test sees them.
fn hide(
    joint: &mut Joint,
    names: &[&'static str],
    random: &mut Random,
) -> (Vec<Shown>, Vec<Truth>) {
    let each: Vec<Shown> = names.iter().map(|n| shown(n, joint, random)).collect();
    let truth = |i: usize| {
        let others = (0..names.len()).filter(|j| *j != i);
        let others: Vec<Vec<f64>> = others.map(|j| each[j].seen.clone()).collect();
        truth(joint, (names[i], &each[i]), &others)
    };
    let truths = (0..names.len()).map(truth).collect();
    (each, truths)
}

/// A case.
pub fn draw(seed: u64) -> Case {
    let mut random = Random::new(seed ^ 0x4a6d_0000);
    let seconds = random.log_uniform(8.0, 30.0);
    let cycle = *pick(&mut random, &[0.004, 0.004, 0.008, 0.012]);
    let first = 1 + random.below(3);
    let count = 1 + usize::from(chance(&mut random, 0.3));
    let mut joints: Vec<Joint> = (0..count)
        .map(|i| Joint::draw(&mut random, first + i, seconds, cycle))
        .collect();
    let told = joints.iter().all(|j| j.stated.is_some());
    let reverses =
        joints[0].torque.iter().any(|t| *t > 0.0) && joints[0].torque.iter().any(|t| *t < 0.0);
    let names = chosen(
        &mut random,
        [5, 13, 17],
        [&EFFECTS, &OUTSIDE],
        |name| match name {
            "stiffness" => told,
            "backlash" => reverses,
            _ => true,
        },
    );
    let (own, truths) = hide(&mut joints[0], &names, &mut random);
    let mut shown = vec![own];
    for joint in joints.iter_mut().skip(1) {
        // The instruments of one controller are read at the same instants.
        let skewed = shown[0].iter().find(|s| s.delay != 0.0).map(|s| s.delay);
        shown.push(skewed.map(|d| causes::skew(joint, d)).into_iter().collect());
    }
    let habit = format!(
        "A{} of {count}, {} s by {} s, {}, K {:.2e}{}, range {:.0} Nm, noise {:.1e} of {:.1e} rad",
        joints[0].number,
        seconds.round(),
        cycle,
        joints[0].programme.name,
        joints[0].stiffness,
        if told { " stated" } else { "" },
        span(&joints[0].torque),
        joints[0].noise,
        joints[0].spread(),
    );
    let files = vec![("run.csv".to_string(), text(&joints, &shown, &mut random))];
    Case {
        seed,
        truths,
        habit,
        files,
    }
}
